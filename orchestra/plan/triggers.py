"""Triggers of a plan: what is done at the start of the run, after a while, and when something happens."""

from __future__ import annotations

from itertools import compress
from operator import attrgetter
from typing import TYPE_CHECKING, Final

from orchestra.plan.reactions import (
    CancelAction,
    ChangeStateAction,
    DeferredAction,
    LoadAction,
    LogAction,
    RegisterAction,
    ShutdownAction,
    SignalAction,
    StartAction,
    StopAction,
    Trigger,
    TriggerEvent,
    UnregisterAction,
)
from orchestra.resolve import reactions

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.plan.model import Plan
    from orchestra.plan.reactions import TriggeredAction
    from orchestra.resolve.model import Resolved

_SHUTDOWN: Final = attrgetter("shutdown_on_exit")


def triggers(
    resolved: Resolved, ids: Sequence[str], components: Sequence[str], before: int
) -> tuple[Trigger, ...]:
    """Return the triggers of `on_exit`, then the others in the order in which they were written.

    `ids` are those of the processes; `before` counts the triggers that a plan has already.
    """
    return tuple(
        Trigger(
            f"{identity}:on_exit",
            TriggerEvent("process_exited", identity),
            (ShutdownAction(f"{identity} has ended", process.location),),
            None,
            deferred=False,
            location=process.location,
        )
        for process, identity in compress(
            zip(resolved.processes, ids, strict=True), map(_SHUTDOWN, resolved.processes)
        )
    ) + tuple(
        _trigger(f"t{number}", item, ids, components)
        for number, item in enumerate(resolved.triggers, before + 1)
    )


def actions(do: Sequence[reactions.TriggeredAction], plan: Plan) -> tuple[TriggeredAction, ...]:
    """Return actions that are carried out on the processes and components of a plan."""
    ids = [process.id for process in plan.processes]
    components = [component.id for component in plan.components]
    return tuple(_action(action, ids, components) for action in do)


def _trigger(
    identity: str, item: reactions.ResolvedTrigger, ids: Sequence[str], components: Sequence[str]
) -> Trigger:
    on = item.on
    target = None if on.target is None else ids[on.target]
    return Trigger(
        identity,
        TriggerEvent(on.event, target, on.stream, on.transition, on.start_state, on.goal_state),
        tuple(_action(action, ids, components) for action in item.do),
        item.delay,
        deferred=any(isinstance(action, reactions.ResolvedDeferred) for action in item.do),
        location=item.location,
        armed=item.armed,
        once=item.once,
        cancel_on_shutdown=item.cancel_on_shutdown,
    )


def _action(  # noqa: C901, PLR0911 - one line per action
    action: reactions.TriggeredAction, ids: Sequence[str], components: Sequence[str]
) -> TriggeredAction:
    at = action.location
    match action:
        case reactions.ResolvedLog(message, _, level):
            return LogAction(message, at, level)
        case reactions.ResolvedStart(index):
            return StartAction(ids[index], at)
        case reactions.ResolvedLoad(index):
            return LoadAction(components[index], at)
        case reactions.ResolvedStop(indexes):
            return StopAction(tuple(ids[index] for index in indexes), at)
        case reactions.ResolvedSignal(indexes, signal):
            return SignalAction(tuple(ids[index] for index in indexes), signal, at)
        case reactions.ResolvedChangeState(indexes, transitions):
            return ChangeStateAction(tuple(ids[index] for index in indexes), transitions, at)
        case reactions.ResolvedRegister(index):
            return RegisterAction(f"t{index + 1}", at)
        case reactions.ResolvedUnregister(index):
            return UnregisterAction(f"t{index + 1}", at)
        case reactions.ResolvedCancel(index):
            return CancelAction(f"t{index + 1}", at)
        case reactions.ResolvedShutdown(reason):
            return ShutdownAction(reason, at)
        case reactions.ResolvedDeferred(ref):
            return DeferredAction(ref, at)
