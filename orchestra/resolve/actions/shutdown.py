"""`shutdown`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.reactions import ResolvedShutdown
from orchestra.resolve.triggers import trigger

if TYPE_CHECKING:
    from orchestra.description.actions.shutdown import Shutdown
    from orchestra.resolve.resolution import Resolution


def visit(action: Shutdown, run: Resolution) -> None:
    """End the run."""
    reason = run.text(action.reason) if action.reason is not None else "reason not given"
    if isinstance(reason, str):
        trigger(ResolvedShutdown(reason, run.at(action.span)), run)
