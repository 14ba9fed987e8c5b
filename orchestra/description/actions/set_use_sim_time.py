"""`set_use_sim_time`: the clock of `ros_timer`."""

from __future__ import annotations

from pydantic import Field

from orchestra.description.entity import Action
from orchestra.description.fields import Flag


class SetUseSimTime(Action):
    """Let `ros_timer` go by simulated time. Nodes are not concerned: they take `set_parameter`."""

    value: Flag = Field(description="Whether it goes by simulated time.")
