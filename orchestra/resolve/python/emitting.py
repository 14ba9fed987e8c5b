"""Events that a description or its code lets happen."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.events.include_launch_description import IncludeLaunchDescription
from orchestra.compat.launch.events.process.process_stdin import ProcessStdin
from orchestra.compat.launch.events.process.shutdown_process import ShutdownProcess
from orchestra.compat.launch.events.process.signal_process import SignalProcess
from orchestra.compat.launch.events.shutdown import Shutdown
from orchestra.compat.launch_ros.events.lifecycle.change_state import ChangeState
from orchestra.compat.refusing import is_lost
from orchestra.errors import Code
from orchestra.resolve.occasions import OpenAction
from orchestra.resolve.python.calling import user_code
from orchestra.resolve.python.deferral import Deferred, defer
from orchestra.resolve.python.visiting import visit_entities
from orchestra.resolve.reactions import (
    ResolvedChangeState,
    ResolvedDeferred,
    ResolvedShutdown,
    ResolvedSignal,
    ResolvedStop,
)
from orchestra.resolve.triggers import trigger

if TYPE_CHECKING:
    from orchestra.location import Location
    from orchestra.resolve.resolution import Resolution


def emit(event: Any, location: Location, run: Resolution) -> None:
    """Plan what an event orders. One that only handlers of the description know happens after the visit."""
    if is_lost(event):  # which is reported
        return
    match event:
        case Shutdown():
            trigger(ResolvedShutdown(_reason(event, run, location), location), run)
        case ShutdownProcess():
            stop = partial(_stop, location)
            trigger(OpenAction(event.process_matcher, location, stop), run)
        case SignalProcess():
            send = partial(_signal, event.signal_name, location)
            trigger(OpenAction(event.process_matcher, location, send), run)
        case ChangeState():
            change = partial(_change, event.transition_id, location)
            trigger(OpenAction(event.lifecycle_node_matcher, location, change), run)
        case IncludeLaunchDescription() if run.later:
            visit_entities([event.launch_description], run)
        case ProcessStdin():
            message = "nobody writes to the standard input of a process: only event handlers hear of this"
            run.problems.warning(Code.BAD_VALUE, message, location)
            _happen(event, location, run)
        case _:
            _happen(event, location, run)


def _happen(event: Any, location: Location, run: Resolution) -> None:
    """Let an event come to the handlers: in the run where that is when it is emitted, else after the visit."""
    if run.later and run.occasion is not None:
        run.occasion.do.append(ResolvedDeferred(defer(Deferred("event", event), location, run), location))
    else:
        run.engine.happening.append((event, location))


def handle_events(run: Resolution) -> None:
    """Hand the events that have happened to the handlers that want them, newest first, and visit what they return.

    A description that an event brings is visited then, by the oldest handler of all, which is launch's own.
    """
    engine = run.engine
    while engine.happening:
        event, location = engine.happening.pop(0)
        for handler in engine.wanting(event, location.span):
            returned: Any = None
            context = engine.context
            context._push_locals()
            with user_code(run, location.span):
                returned = handler.handle(event, context)
            if returned is not None:
                visit_entities([returned] if not isinstance(returned, list | tuple) else returned, run)
            context._pop_locals()
        if isinstance(event, IncludeLaunchDescription):
            visit_entities([event.launch_description], run)


def _stop(location: Location, indexes: tuple[int, ...]) -> ResolvedStop:
    return ResolvedStop(indexes, location)


def _signal(name: str, location: Location, indexes: tuple[int, ...]) -> ResolvedSignal:
    return ResolvedSignal(indexes, name, location)


def _change(transition: int, location: Location, indexes: tuple[int, ...]) -> ResolvedChangeState:
    return ResolvedChangeState(indexes, (transition,), location)


def _reason(event: Shutdown, run: Resolution, location: Location) -> str:
    """Return why the run ends; a reason may be made of substitutions."""
    if isinstance(event.reason, str):
        return event.reason
    texts: list[str] = []
    with user_code(run, location.span):
        texts += [
            item if isinstance(item, str) else item.perform(run.engine.context) for item in event.reason
        ]
    return "".join(texts)
