"""`timer`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.model import ResolvedTrigger

if TYPE_CHECKING:
    from orchestra.description.actions.timer import Timer
    from orchestra.resolve.resolution import Resolution


def visit(action: Timer, run: Resolution) -> None:
    """Keep the children for later: they see the scope as it is here, and set nothing outside."""
    period = run.number(action.period)
    outer, outer_delay = run.delayed, run.delay
    run.delayed, run.delay = [], outer_delay + (period if isinstance(period, float) else 0.0)
    with run.scope.nested():
        run.visit(action.children, run)
    trigger = ResolvedTrigger(tuple(run.delayed), run.delay, run.at(action.span))
    run.delayed, run.delay = outer, outer_delay
    run.found.triggers.append(trigger)
