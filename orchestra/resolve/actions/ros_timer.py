"""`ros_timer`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.actions import timer

if TYPE_CHECKING:
    from orchestra.description.actions.ros_timer import RosTimer
    from orchestra.resolve.resolution import Resolution


def visit(action: RosTimer, run: Resolution) -> None:
    """Keep the children for later. The machine's clock counts: that is ROS time, unless it is simulated."""
    if run.found.simulated_time is not None:
        run.problems.warning(
            Code.BAD_VALUE,
            "this timer goes by the clock of the machine, not by simulated time",
            run.at(action.span),
            notes=(f"simulated time is asked for at {run.found.simulated_time}",),
        )
    timer.visit(action, run)
