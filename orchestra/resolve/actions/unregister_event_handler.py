"""Event handlers that wait no more."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.occasions import Registration

if TYPE_CHECKING:
    from orchestra.description.actions.unregister_event_handler import UnregisterEventHandler
    from orchestra.resolve.resolution import Resolution


def visit(action: UnregisterEventHandler, run: Resolution) -> None:
    """Let a handler wait no more: during the run, or from the moment when what is around this is carried out."""
    location = run.at(action.span)
    if run.occasion is not None:
        run.occasion.do.append(Registration(action.handler, location, armed=False))
        return
    try:
        run.engine.unregister(action.handler)
    except ValueError as error:
        run.problems.error(Code.BAD_VALUE, str(error), location)
