"""`set_use_sim_time`: the clock of `ros_timer`."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Flag
from orchestra.description.model import field


class SetUseSimTime(Action):
    """Let `ros_timer` go by simulated time. Nodes are not concerned: they take `set_parameter`."""

    value: Flag = field(description="Whether it goes by simulated time.")
