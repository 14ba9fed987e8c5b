"""`ros_timer`: actions after a while of ROS time."""

from __future__ import annotations

from orchestra.description.actions.timer import Timer


class RosTimer(Timer):
    """Actions to carry out some seconds of ROS time after the run has started."""
