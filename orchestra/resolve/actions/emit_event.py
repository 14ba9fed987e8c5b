"""Events that a description lets happen."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.python.emitting import emit

if TYPE_CHECKING:
    from orchestra.description.actions.emit_event import EmitEvent
    from orchestra.resolve.resolution import Resolution


def visit(action: EmitEvent, run: Resolution) -> None:
    """Let an event happen: an order to processes or the end of the run is planned, others come after the visit."""
    emit(action.event, run.at(action.span), run)
