"""`reset_env`: undoes changes of the environment."""

from __future__ import annotations

from orchestra.description.entity import Action


class ResetEnv(Action):
    """Make the environment what it was when the launch began."""
