"""Triggers of what the visit has collected, when all processes are known."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.dataclass import dataclass
from orchestra.errors import Code
from orchestra.location import Location
from orchestra.resolve.occasions import Occasion, Occasions, OpenAction, Registration
from orchestra.resolve.reactions import (
    ResolvedCancel,
    ResolvedEvent,
    ResolvedLoad,
    ResolvedRegister,
    ResolvedStart,
    ResolvedTrigger,
    ResolvedUnregister,
)

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.resolve.occasions import Action
    from orchestra.resolve.reactions import TriggeredAction
    from orchestra.resolve.resolution import Resolution


@dataclass(frozen=True, slots=True)
class _Due:
    """An occasion that comes with an event. `behind`: after everything else that comes with the same event.

    `unmet`: the process that it is about is not there, so that nothing sets it off.
    """

    occasion: Occasion
    event: ResolvedEvent
    delay: float | None
    behind: bool = False
    unmet: bool = False


def settled(run: Resolution) -> tuple[ResolvedTrigger, ...]:
    """Return the triggers of what has been collected since the last time, one for each process that each is about."""
    idle = all(_serves_code(kept.deferred.target) for kept in run.found.kept)
    full = (
        occasion
        for occasion in run.found.occasions
        if occasion.do and not (idle and _serves_code(occasion.handler)) and not _is_cancelled(occasion)
    )
    due = [*_met(run), *(found for occasion in full for found in _due_or_unmet(occasion, run))]
    due.sort(key=lambda found: found.behind)
    for position, found in enumerate(due, run.found.triggers):
        if found.unmet:
            continue
        if found.occasion.handler is not None:
            run.found.positions.setdefault(id(found.occasion.handler), []).append(position)
        if found.occasion.timers:
            run.found.timed.append((position, found.occasion))
    run.found.triggers += len(due)
    triggers = tuple(_trigger(found, run) for found in due)
    run.found.occasions = Occasions()
    return triggers


def _trigger(due: _Due, run: Resolution) -> ResolvedTrigger:
    occasion = due.occasion
    return ResolvedTrigger(
        due.event,
        settled_actions(occasion, run),
        due.delay,
        occasion.location,
        occasion.armed and not due.unmet,
        occasion.once,
        occasion.cancel_on_shutdown,
    )


def cancelled(run: Resolution) -> tuple[ResolvedCancel, ...]:
    """Return that the triggers of timers are cancelled which code of the description has cancelled since."""
    gone = [entry for entry in run.found.timed if _is_cancelled(entry[1])]
    run.found.timed = [entry for entry in run.found.timed if not _is_cancelled(entry[1])]
    return tuple(ResolvedCancel(position, occasion.location) for position, occasion in gone)


def _is_cancelled(occasion: Occasion) -> bool:
    return any(getattr(timer, "_is_cancelled", False) for timer in occasion.timers)


def settled_actions(occasion: Occasion, run: Resolution) -> tuple[TriggeredAction, ...]:
    """Return what is done on an occasion."""
    return tuple(done for action in occasion.do for done in _actions(action, run))


def processes_of(target: Any, run: Resolution) -> tuple[int, ...]:  # noqa: ANN401 - an object or a predicate
    """Return the processes that an object of a Python launch file made, or those whose objects a predicate accepts."""
    made = run.found.made_by(target)
    if not made and callable(target):
        made = run.engine.accepted(target)
    return made


def _serves_code(handler: Any) -> bool:  # noqa: ANN401 - an event handler or None
    """Return whether all that a handler does is for other code that may be called during the run."""
    return bool(getattr(handler, "_serves_code", False))


def _met(run: Resolution) -> list[_Due]:
    """Return what waited for a process that has come in the meantime: code has started it."""
    waiting, run.found.unmet = run.found.unmet, []
    due = []
    for occasion in waiting:
        found = list(_due(occasion, run))
        due += found
        if not found and not _is_cancelled(occasion):
            run.found.unmet.append(occasion)
    return due


def _due_or_unmet(occasion: Occasion, run: Resolution) -> list[_Due]:
    """Return when an occasion comes; one that never comes still keeps what it starts from starting with the run.

    A condition may leave a process out that a handler waits for, and code may start one later.
    """
    found = list(_due(occasion, run))
    if found:
        return found
    run.found.unmet.append(occasion)
    _tell_unadded(occasion, run)
    if not any(isinstance(action, ResolvedStart | ResolvedLoad) for action in occasion.do):
        return []
    on = occasion.on
    event = ResolvedEvent(on.event, None, on.stream, on.transition, on.start_state, on.goal_state)
    return [_Due(occasion, event, occasion.delay, unmet=True)]


def _tell_unadded(occasion: Occasion, run: Resolution) -> None:
    """Warn of an event handler that waits for an action of a Python launch file which is made and added to nothing."""
    place = getattr(occasion.handler, "_place", None)
    if occasion.on.target is not None and place is not None:
        # Here, because only what may be a mistake needs it.
        from orchestra.compat.unadded import target_unadded  # noqa: PLC0415

        span = target_unadded(place)
        if span is not None:
            message = "what is waited for is added to no launch description: it never starts"
            run.problems.warning(
                Code.UNKNOWN_DEPENDENCY, message, Location(span, occasion.location.included_from)
            )


def _due(occasion: Occasion, run: Resolution) -> Iterable[_Due]:
    on = occasion.on
    if on.event == "process_completed" and on.target is not None:
        yield from _completions(occasion, run)
        return
    targets: tuple[int | None, ...] = (None,) if on.target is None else processes_of(on.target, run)
    for target in targets:
        event = ResolvedEvent(on.event, target, on.stream, on.transition, on.start_state, on.goal_state)
        yield _Due(occasion, event, occasion.delay)


def _completions(occasion: Occasion, run: Resolution) -> Iterable[_Due]:
    """Return when an action is done: a process with its last end, a timer when it goes off, another at its visit."""
    target = occasion.on.target
    found = processes_of(target, run)
    yield from (_Due(occasion, ResolvedEvent("process_completed", index), occasion.delay) for index in found)
    if found or id(target) not in run.found.carried_out:
        return
    timer = run.found.occasions.of_timer(target)
    if timer is not None:
        delay = (timer.delay or 0.0) + (occasion.delay or 0.0)
        yield from (_Due(occasion, due.event, delay, behind=True) for due in _due(timer, run))
        return
    yield _Due(occasion, ResolvedEvent("run_started"), occasion.delay, behind=True)


def _actions(action: Action, run: Resolution) -> Iterable[TriggeredAction]:
    if isinstance(action, OpenAction):
        yield action.make(processes_of(action.target, run))
    elif isinstance(action, Registration):
        kind = ResolvedRegister if action.armed else ResolvedUnregister
        positions = run.found.positions.get(id(action.handler), ())
        yield from (kind(position, action.location) for position in positions)
    else:
        yield action
