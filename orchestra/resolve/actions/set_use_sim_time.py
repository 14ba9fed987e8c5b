"""`set_use_sim_time`."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from orchestra.description.actions.set_use_sim_time import SetUseSimTime
    from orchestra.resolve.resolution import Resolution


def visit(action: SetUseSimTime, run: Resolution) -> None:
    """Remember which clock `ros_timer` is to go by; upstream it is one setting for the whole launch."""
    simulated = run.flag(action.value)
    if isinstance(simulated, bool):
        run.found.simulated_time = run.at(action.span) if simulated else None
