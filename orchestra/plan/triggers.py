"""Triggers of a plan: what happens at the start of the run, after a while, and when a process ends."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.plan.reactions import LogAction, ShutdownAction, StartAction, Trigger, TriggerEvent
from orchestra.resolve.model import ResolvedLog, ResolvedStart

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.plan.reactions import TriggeredAction
    from orchestra.resolve.model import Resolved
    from orchestra.resolve.model import TriggeredAction as ResolvedAction


def triggers(resolved: Resolved, ids: Sequence[str]) -> tuple[Trigger, ...]:
    """Return the triggers in the order in which they were written, then those of `on_exit`."""
    started = TriggerEvent("run_started")
    written = tuple(
        Trigger(
            f"t{number}",
            started,
            tuple(_action(action, ids) for action in item.do),
            item.delay,
            deferred=False,
            location=item.location,
        )
        for number, item in enumerate(resolved.triggers, 1)
    )
    ends = tuple(
        Trigger(
            f"{identity}:on_exit",
            TriggerEvent("process_exited", identity),
            (ShutdownAction(f"{identity} has ended", process.location),),
            None,
            deferred=False,
            location=process.location,
        )
        for process, identity in zip(resolved.processes, ids, strict=True)
        if process.shutdown_on_exit
    )
    return written + ends


def _action(action: ResolvedAction, ids: Sequence[str]) -> TriggeredAction:
    if isinstance(action, ResolvedLog):
        return LogAction(action.message, action.location)
    if isinstance(action, ResolvedStart):
        return StartAction(ids[action.index], action.location)
    return ShutdownAction(action.reason, action.location)
