"""`EnableRmwIsolation`: keeps what is launched from other systems (newer ROS releases)."""

from __future__ import annotations

from orchestra.compat.launch.action import Action


class EnableRmwIsolation(Action):
    """Do nothing: discovery is limited to this machine unless the caller says otherwise."""
