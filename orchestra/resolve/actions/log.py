"""`log`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.model import ResolvedLog
from orchestra.resolve.triggers import trigger

if TYPE_CHECKING:
    from orchestra.description.actions.log import Log
    from orchestra.resolve.resolution import Resolution


def visit(action: Log, run: Resolution) -> None:
    """Print a message when the run starts, or when the timer around it goes off."""
    message = run.text(action.message)
    if isinstance(message, str):
        trigger(ResolvedLog(message, run.at(action.span)), run)
