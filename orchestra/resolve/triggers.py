"""Actions that the run carries out: at its start, or when the timer around them goes off."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.occasions import Occasion, OpenEvent

if TYPE_CHECKING:
    from orchestra.resolve.occasions import Action
    from orchestra.resolve.resolution import Resolution


def trigger(action: Action, run: Resolution) -> None:
    """Keep an action for what is waited for around it, or else for the start of the run."""
    if run.occasion is not None:
        run.occasion.do.append(action)
    else:
        run.found.occasions.append(Occasion(OpenEvent("run_started"), action.location, do=[action]))
