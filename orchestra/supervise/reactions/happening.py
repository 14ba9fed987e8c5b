"""What happened, as triggers see it: which of them it sets off, in which order, and what the resolver is told of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.values import EventName

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.plan.reactions import Trigger, TriggerEvent
    from orchestra.supervise.process.ending import Ending


@dataclass(frozen=True, slots=True)
class Happening:
    """One event of a run. `facts` are what a question to the resolver says of it besides."""

    event: EventName
    target: str | None = None
    facts: dict[str, Any] = field(default_factory=dict)

    @property
    def frequent(self) -> bool:
        """Whether there may be more of them than anybody can answer."""
        return self.event == "process_output"


def run_started() -> Happening:
    """Return the beginning of the run."""
    return Happening("run_started")


def shutdown(reason: str, *, due_to_sigint: bool) -> Happening:
    """Return the beginning of the end of the run."""
    return Happening("shutdown", None, {"reason": reason, "due_to_sigint": due_to_sigint})


def started(process: str, pid: int | None) -> Happening:
    """Return the start of a program."""
    return Happening("process_started", process, {"pid": pid})


def ended(process: str, pid: int | None, ending: Ending, *, last: bool) -> Happening:
    """Return the end of a program; `last` says that no restart will follow."""
    code = ending.code if ending.signal is None else -ending.signal
    facts = {"pid": pid, "returncode": code, "reason": ending.reason}
    return Happening("process_completed" if last else "process_exited", process, facts)


def wrote(process: str, pid: int | None, stream: str, data: bytes) -> Happening:
    """Return some bytes of a program's output."""
    import base64  # noqa: PLC0415 - few triggers hear output

    facts = {"pid": pid, "stream": stream, "text": base64.b64encode(data).decode()}
    return Happening("process_output", process, facts)


def state_changed(
    process: str, pid: int | None, transition: str, start_state: str, goal_state: str
) -> Happening:
    """Return a transition of a lifecycle node, with the labels of lifecycle_msgs/msg/TransitionEvent."""
    facts = {"pid": pid, "transition": transition, "start_state": start_state, "goal_state": goal_state}
    return Happening("state_changed", process, facts)


def matches(on: TriggerEvent, happening: Happening) -> bool:
    """Tell whether a trigger waits for this."""
    facts = happening.facts
    return (
        on.event == happening.event
        and on.target in (None, happening.target)
        and on.stream in (None, facts.get("stream"))
        and on.transition in (None, facts.get("transition"))
        and on.start_state in (None, facts.get("start_state"))
        and on.goal_state in (None, facts.get("goal_state"))
    )


def in_order(triggers: Iterable[Trigger], happening: Happening) -> list[Trigger]:
    """Return those that it sets off, of all that wait, oldest first: who waits longest comes last, as upstream.

    Before all others comes what the process itself says about its end, `ID:on_exit`; what begins with the run begins in
    the order in which it was written.
    """
    found = [trigger for trigger in triggers if matches(trigger.on, happening)]
    if happening.event == "run_started":
        return found
    own = f"{happening.target}:on_exit"
    found.reverse()
    return sorted(found, key=lambda trigger: not trigger.id.startswith(own))


def question(ref: int, happening: Happening) -> dict[str, Any]:
    """Return what the resolver is asked."""
    event: dict[str, Any] = {"event": happening.event, **happening.facts}
    if happening.target is not None:
        event["process"] = happening.target
    return {"ref": ref, "event": event}
