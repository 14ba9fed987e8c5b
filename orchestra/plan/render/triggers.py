"""A trigger in one line: when it comes, and what it does then."""

from __future__ import annotations

from typing import TYPE_CHECKING

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
    UnregisterAction,
)

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.plan.reactions import Trigger, TriggeredAction, TriggerEvent

_TRANSITIONS = {1: "configure", 2: "clean up", 3: "activate", 4: "deactivate", 5: "shut down", 6: "shut down"}


def trigger_lines(triggers: Sequence[Trigger]) -> Iterator[str]:
    """Yield the lines of all triggers of a plan."""
    actions = (action for trigger in triggers for action in trigger.do)
    registered = {action.trigger for action in actions if isinstance(action, RegisterAction)}
    for trigger in triggers:
        yield _line(trigger, waits=trigger.armed or trigger.id in registered)


def _line(trigger: Trigger, *, waits: bool) -> str:
    """Return the line; a trigger that does not wait is about a process that does not start."""
    once = "the first time, " if trigger.once else ""
    armed = "" if trigger.armed or not waits else f", once {trigger.id} is registered"
    done = "; ".join(map(action_line, trigger.do)) or "nothing"
    return f"{event_line(trigger, waits=waits)}{armed}: {once}{done}  ({trigger.location})"


def event_line(trigger: Trigger, *, waits: bool = True) -> str:
    """Return when the actions of a trigger are carried out."""
    delay = "" if trigger.delay is None else f"{trigger.delay:g} s after "
    anybody = "any process" if waits else "a process that is not started"
    return f"{delay}{_event(trigger.on, trigger.on.target or anybody)}"


def _event(event: TriggerEvent, target: str) -> str:
    match event.event:
        case "run_started":
            return "the start of the run"
        case "shutdown":
            return "the shutdown of the run"
        case "process_started":
            return f"the start of {target}"
        case "process_exited":
            return f"the end of {target}"
        case "process_completed":
            return f"the last end of {target}"
        case "process_output":
            return f"output of {target}{f' on {event.stream}' if event.stream else ''}"
        case "state_changed":
            return f"a change of state of {target}{_narrowed(event)}"


def _narrowed(event: TriggerEvent) -> str:
    parts = {"by": event.transition, "from": event.start_state, "to": event.goal_state}
    return "".join(f" {word} {value}" for word, value in parts.items() if value is not None)


def action_line(action: TriggeredAction) -> str:  # noqa: C901, PLR0911 - one line per action
    """Return what is done, in a few words."""
    match action:
        case LogAction(message, _, level):
            return f"log {message!r}{'' if level == 'info' else f' as {level}'}"
        case StartAction(process):
            return f"start {process}"
        case LoadAction(component):
            return f"load {component}"
        case StopAction(processes):
            return f"stop {' '.join(processes)}"
        case SignalAction(processes, signal):
            return f"send {signal} to {' '.join(processes)}"
        case ChangeStateAction(processes, transitions):
            steps = ", ".join(_TRANSITIONS.get(step, str(step)) for step in transitions)
            return f"{steps} {' '.join(processes)}"
        case RegisterAction(trigger):
            return f"register {trigger}"
        case UnregisterAction(trigger):
            return f"unregister {trigger}"
        case CancelAction(trigger):
            return f"cancel {trigger}"
        case ShutdownAction(reason):
            return f"shut down, {reason}"
        case DeferredAction():
            return "decided when it happens"
