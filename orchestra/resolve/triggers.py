"""Actions that the run carries out: at its start, or when the timer around them goes off."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.model import ResolvedTrigger

if TYPE_CHECKING:
    from orchestra.resolve.model import TriggeredAction
    from orchestra.resolve.resolution import Resolution


def trigger(action: TriggeredAction, run: Resolution) -> None:
    """Keep an action for the timer around it, or else for the start of the run."""
    if run.delayed is not None:
        run.delayed.append(action)
    else:
        run.found.triggers.append(ResolvedTrigger((action,), None, action.location))
