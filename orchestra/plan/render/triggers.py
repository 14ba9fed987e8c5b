"""A trigger in one line: when it comes, and what it does then."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.plan.reactions import LogAction, StartAction

if TYPE_CHECKING:
    from orchestra.plan.reactions import Trigger, TriggeredAction, TriggerEvent


def trigger_line(trigger: Trigger) -> str:
    """Return the line."""
    delay = "" if trigger.delay is None else f"{trigger.delay:g} s after "
    done = "decided when it happens" if trigger.deferred else "; ".join(map(_action, trigger.do))
    return f"{delay}{_event(trigger.on)}: {done}  ({trigger.location})"


def _event(event: TriggerEvent) -> str:
    return "the start of the run" if event.event == "run_started" else f"the end of {event.target}"


def _action(action: TriggeredAction) -> str:
    if isinstance(action, LogAction):
        return f"log {action.message!r}"
    if isinstance(action, StartAction):
        return f"start {action.process}"
    return f"shut down, {action.reason}"
