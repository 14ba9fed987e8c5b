"""Event handlers: what they do is resolved where they are written, as far as it is known."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.occasions import Occasion, OpenEvent, Registration
from orchestra.resolve.python.deferral import Deferred, defer
from orchestra.resolve.reactions import ResolvedDeferred

if TYPE_CHECKING:
    from orchestra.description.actions.register_event_handler import RegisterEventHandler
    from orchestra.description.handlers import Handler
    from orchestra.location import Location
    from orchestra.resolve.reactions import EventName
    from orchestra.resolve.resolution import Resolution

# What an event handler with a matcher of its own may be waiting for; events of users' own come besides.
_ANY: tuple[EventName, ...] = ("process_started", "process_exited", "state_changed", "shutdown")


def visit(action: RegisterEventHandler, run: Resolution) -> None:
    """Wait for events; inside a timer or another event handler from the moment when that is carried out."""
    location = run.at(action.span)
    for handler in action.handlers:
        run.engine.register(handler.origin, first=True)
        for occasion in _occasions(handler, location, run):
            if handler.callback is None and handler.event != "custom":
                run.collect(occasion, handler.children or ())
            else:
                deferred = Deferred("handler", handler.origin, handler.callback)
                occasion.do.append(ResolvedDeferred(defer(deferred, location, run), location))
                run.found.occasions.append(occasion)
        if run.later and run.occasion is not None:
            run.occasion.do.append(Registration(handler.origin, location, armed=True))


def _occasions(handler: Handler, location: Location, run: Resolution) -> list[Occasion]:
    names = _ANY if handler.event == "custom" else (handler.event,)
    if handler.stream == "stdin":  # nothing is ever read from there
        return []
    events = [
        OpenEvent(
            name,
            handler.target,
            handler.stream,
            handler.transition,
            handler.start_state,
            handler.goal_state,
        )
        for name in names
    ]
    armed = not run.later
    return [
        Occasion(event, location, handler=handler.origin, armed=armed, once=handler.once) for event in events
    ]
