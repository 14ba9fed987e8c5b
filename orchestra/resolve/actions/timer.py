"""`timer`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.fields import replace
from orchestra.resolve.occasions import Occasion, OpenEvent

if TYPE_CHECKING:
    from orchestra.description.actions.timer import Timer
    from orchestra.resolve.resolution import Resolution


def visit(action: Timer, run: Resolution) -> None:
    """Keep the children for later: they see the scope as it is here, and set nothing outside.

    A timer inside a timer or an event handler begins when those are carried out.
    """
    period, cancelled = run.number(action.period), run.flag(action.cancel_on_shutdown, default=True)
    outer = run.occasion or Occasion(OpenEvent("run_started"), run.at(action.span))
    seconds = period if isinstance(period, float) else 0.0
    run.collect(
        replace(
            outer,
            location=run.at(action.span),
            delay=(outer.delay or 0.0) + seconds,
            cancel_on_shutdown=cancelled is not False,
            now=False,
            timers=(*outer.timers, action.origin),
            do=[],
        ),
        action.children,
    )
