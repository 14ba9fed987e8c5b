"""What has happened in a run, as the event objects that event handlers take."""

from __future__ import annotations

from base64 import b64decode
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.actions.execute_local import ExecuteLocal
from orchestra.compat.launch.events.execution_complete import ExecutionComplete
from orchestra.compat.launch.events.process.process_exited import ProcessExited
from orchestra.compat.launch.events.process.process_started import ProcessStarted
from orchestra.compat.launch.events.process.process_stderr import ProcessStderr
from orchestra.compat.launch.events.process.process_stdout import ProcessStdout
from orchestra.compat.launch.events.process.running_process_event import RunningProcessEvent
from orchestra.compat.launch.events.shutdown import Shutdown
from orchestra.compat.launch_ros.events.lifecycle.state_transition import StateTransition
from orchestra.resolve.running import words_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.resolve.model import ResolvedProcess


def observed(happened: Mapping[str, Any], process: ResolvedProcess | None, name: str) -> Any:
    """Return the event as `event_object`; the action that started the process knows of it too."""
    event = event_object(happened, process, name)
    if (
        process is not None
        and isinstance(process.origin, ExecuteLocal)
        and isinstance(event, RunningProcessEvent)
    ):
        process.origin._observe(event)
    return event


def event_object(happened: Mapping[str, Any], process: ResolvedProcess | None, name: str) -> Any:
    """Return the event of `launch.events` for one of a plan's; `name` is that of the process, which is unique.

    Raises `ValueError` for what no handler of Python can wait for.
    """
    kind = happened["event"]
    if kind == "shutdown":
        reason, interrupted = happened.get("reason") or "", bool(happened.get("due_to_sigint"))
        return Shutdown(reason=reason, due_to_sigint=interrupted)
    if process is None:
        raise ValueError(f"nobody knows which process the event '{kind}' is about")
    if kind == "process_completed":
        return ExecutionComplete(action=process.origin)
    if kind == "state_changed":
        return StateTransition(action=process.origin, msg=_transition(happened))
    running = _running(happened, process, name)
    if kind == "process_started":
        return ProcessStarted(**running)
    if kind == "process_exited":
        return ProcessExited(returncode=happened["returncode"], **running)
    if kind == "process_output":
        written = ProcessStderr if happened["stream"] == "stderr" else ProcessStdout
        return written(text=b64decode(happened["text"]), **running)
    raise ValueError(f"no event handler waits for '{kind}'")


def _running(happened: Mapping[str, Any], process: ResolvedProcess, name: str) -> dict[str, Any]:
    details = getattr(process.origin, "process_details", None) or {}
    return {
        "action": process.origin,
        "name": name,
        "cmd": words_of(process),
        "cwd": process.cwd,
        "env": details.get("env"),
        "pid": happened.get("pid") or 0,
    }


def _transition(happened: Mapping[str, Any]) -> SimpleNamespace:
    """Return a TransitionEvent by its fields: this process has no ROS messages."""
    return SimpleNamespace(
        timestamp=0,
        transition=SimpleNamespace(label=happened.get("transition") or "", id=0),
        start_state=SimpleNamespace(label=happened.get("start_state") or "", id=0),
        goal_state=SimpleNamespace(label=happened.get("goal_state") or "", id=0),
    )
