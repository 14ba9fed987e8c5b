"""`log`."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from orchestra.description.actions.log import LEVELS
from orchestra.resolve.context import Poison
from orchestra.resolve.reactions import ResolvedLog
from orchestra.resolve.triggers import trigger

if TYPE_CHECKING:
    from orchestra.description.actions.log import Log
    from orchestra.resolve.resolution import Resolution
    from orchestra.values import Level


def visit(action: Log, run: Resolution) -> None:
    """Print a message when the run starts, or when the timer around it goes off."""
    message, level = run.text(action.message), run.word(action.level, LEVELS)
    if isinstance(message, str) and not isinstance(level, Poison):
        trigger(ResolvedLog(message, run.at(action.span), cast("Level", level or "info")), run)
