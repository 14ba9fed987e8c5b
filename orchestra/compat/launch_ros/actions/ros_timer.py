"""`ROSTimer`: actions after a while of ROS time."""

from __future__ import annotations

from orchestra.compat.launch.actions.timer_action import TimerAction
from orchestra.description.actions.ros_timer import RosTimer as RosTimerModel


class ROSTimer(TimerAction):
    """Visit actions once, when `period` seconds of ROS time are over."""

    _model = RosTimerModel


RosTimer = ROSTimer
