"""Triggers of what the visit has collected, when all processes are known."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.resolve.occasions import OpenAction, Registration
from orchestra.resolve.reactions import (
    ResolvedEvent,
    ResolvedRegister,
    ResolvedTrigger,
    ResolvedUnregister,
)

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.resolve.occasions import Action, Occasion, OpenEvent
    from orchestra.resolve.reactions import TriggeredAction
    from orchestra.resolve.resolution import Resolution


def settled(run: Resolution) -> tuple[ResolvedTrigger, ...]:
    """Return the triggers of what has been collected since the last time, one for each process that each is about."""
    idle = all(_serves_code(kept.deferred.target) for kept in run.found.kept)
    full = (
        occasion
        for occasion in run.found.occasions
        if occasion.do and not (idle and _serves_code(occasion.handler))
    )
    events = [(occasion, event) for occasion in full for event in _events(occasion, run)]
    for position, (occasion, _) in enumerate(events, run.found.triggers):
        if occasion.handler is not None:
            run.found.positions.setdefault(id(occasion.handler), []).append(position)
    run.found.triggers += len(events)
    run.found.occasions = []
    return tuple(
        ResolvedTrigger(
            event,
            settled_actions(occasion, run),
            occasion.delay,
            occasion.location,
            occasion.armed,
            occasion.once,
            occasion.cancel_on_shutdown,
        )
        for occasion, event in events
    )


def settled_actions(occasion: Occasion, run: Resolution) -> tuple[TriggeredAction, ...]:
    """Return what is done on an occasion."""
    return tuple(done for action in occasion.do for done in _actions(action, run))


def processes_of(target: Any, run: Resolution) -> tuple[int, ...]:  # noqa: ANN401 - an object or a predicate
    """Return the processes that an object of a Python launch file made, or those whose objects a predicate accepts."""
    processes = list(enumerate(run.found.processes))
    made = tuple(index for index, process in processes if process.origin is target)
    if made or not callable(target):
        return made
    return tuple(index for index, process in processes if run.engine.accepts(target, index, process))


def _serves_code(handler: Any) -> bool:  # noqa: ANN401 - an event handler or None
    """Return whether all that a handler does is for other code that may be called during the run."""
    return bool(getattr(handler, "_serves_code", False))


def _events(occasion: Occasion, run: Resolution) -> Iterable[ResolvedEvent]:
    on = occasion.on
    if on.event == "process_completed":
        yield from _completions(on, run)
        return
    targets: tuple[int | None, ...] = (None,) if on.target is None else processes_of(on.target, run)
    for target in targets:
        yield ResolvedEvent(on.event, target, on.stream, on.transition, on.start_state, on.goal_state)


def _completions(on: OpenEvent, run: Resolution) -> Iterable[ResolvedEvent]:
    if on.target is None:
        yield ResolvedEvent("process_completed")
        return
    found = processes_of(on.target, run)
    yield from (ResolvedEvent("process_completed", index) for index in found)
    if not found and id(on.target) in run.found.carried_out:
        yield ResolvedEvent("run_started")


def _actions(action: Action, run: Resolution) -> Iterable[TriggeredAction]:
    if isinstance(action, OpenAction):
        yield action.make(processes_of(action.target, run))
    elif isinstance(action, Registration):
        kind = ResolvedRegister if action.armed else ResolvedUnregister
        positions = run.found.positions.get(id(action.handler), ())
        yield from (kind(position, action.location) for position in positions)
    else:
        yield action
