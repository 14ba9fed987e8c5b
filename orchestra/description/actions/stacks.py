"""Saves and restores the environment and the variables (words of Python launch files alone)."""

from __future__ import annotations

from orchestra.description.entity import Action


class PushEnvironment(Action):
    """Save the environment."""


class PopEnvironment(Action):
    """Restore the environment that was saved last."""


class PushLaunchConfigurations(Action):
    """Save variables, the pushed namespace, and the parameters and remappings of all nodes."""


class PopLaunchConfigurations(Action):
    """Restore what was saved last."""
