"""Event handlers: what they do is resolved where they are written, as far as it is known."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.mentions import is_of_the_moment
from orchestra.resolve.occasions import Occasion, OpenEvent, Registration
from orchestra.resolve.python.deferral import Deferred, defer
from orchestra.resolve.reactions import ResolvedDeferred

if TYPE_CHECKING:
    from orchestra.description.actions.register_event_handler import RegisterEventHandler
    from orchestra.description.handlers import Handler
    from orchestra.location import Location
    from orchestra.resolve.resolution import Resolution
    from orchestra.values import EventName

# What an event handler with a matcher of its own may be waiting for; events of users' own come besides.
_ANY: tuple[EventName, ...] = ("process_started", "process_exited", "state_changed", "shutdown")


def visit(action: RegisterEventHandler, run: Resolution) -> None:
    """Wait for events; inside a timer or another event handler from the moment when that is carried out."""
    location = run.at(action.span)
    for handler in action.handlers:
        run.engine.waits(handler.origin)
        for occasion in _occasions(handler, location, run):
            if _is_known(handler):
                run.collect(occasion, handler.children or ())
            else:
                callback = handler.callback or handler.origin.handle
                deferred = Deferred("handler", handler.origin, callback)
                occasion.do.append(ResolvedDeferred(defer(deferred, location, run), location))
                run.found.occasions.append(occasion)
        if run.later and run.occasion is not None:
            run.occasion.do.append(Registration(handler.origin, location, armed=True))


def _is_known(handler: Handler) -> bool:
    """Return whether it is known without the event what is done."""
    custom = handler.callback is not None or handler.event == "custom"
    return not custom and not is_of_the_moment(handler.children or ())


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
