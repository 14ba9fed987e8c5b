from __future__ import annotations

import signal
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.compat.launch import events
from orchestra.compat.launch.actions import ExecuteProcess, LogInfo, TimerAction
from orchestra.compat.launch.events import process

if TYPE_CHECKING:
    from orchestra.compat.launch.event import Event
    from orchestra.compat.launch.events.matchers import ActionMatcher

_RUNNING: dict[str, Any] = {"name": "ls-1", "cmd": ["/bin/ls"], "cwd": None, "env": {}, "pid": 12}


def _process() -> ExecuteProcess:
    return ExecuteProcess(cmd=["ls"])


@pytest.mark.conforms(
    "1.6 ExecutionComplete",
    "1.6 IncludeLaunchDescription",
    "1.6 Shutdown",
    "1.6 TimerEvent",
    "1.6 process.ProcessStarted",
    "1.6 process.ProcessExited",
    "1.6 process.ProcessIO",
    "1.6 process.ProcessStdin",
    "1.6 process.ProcessStdout",
    "1.6 process.ProcessStderr",
    "1.6 process.SignalProcess",
    "1.6 process.ShutdownProcess",
    "1.6 process.ProcessTargetedEvent",
    "1.2 Event",
)
@pytest.mark.parametrize(
    ("event", "name", "values"),
    [
        (events.ExecutionComplete(action=LogInfo(msg="x")), "launch.events.ExecutionComplete", {}),
        (
            events.Shutdown(),
            "launch.events.Shutdown",
            {"reason": "reason not given", "due_to_sigint": False},
        ),
        (events.Shutdown(reason="x", due_to_sigint=True), "launch.events.Shutdown", {"due_to_sigint": True}),
        (events.TimerEvent(timer_action=TimerAction(period=1.0, actions=[])), "launch.events.TimerEvent", {}),
        (
            events.IncludeLaunchDescription("d"),
            "launch.events.IncludeLaunchDescription",
            {"launch_description": "d"},
        ),
        (
            process.ProcessStarted(action=None, **_RUNNING),
            "launch.events.process.ProcessStarted",
            {"process_name": "ls-1", "cmd": ["/bin/ls"], "cwd": None, "env": {}, "pid": 12},
        ),
        (
            process.ProcessExited(returncode=-9, action=None, **_RUNNING),
            "launch.events.process.ProcessExited",
            {"returncode": -9},
        ),
        (
            process.ProcessIO(text=b"x", fd=1, action=None, **_RUNNING),
            "launch.events.process.ProcessIO",
            {"text": b"x", "from_stdin": False, "from_stdout": True, "from_stderr": False},
        ),
        (
            process.ProcessStdin(text=b"x", action=None, **_RUNNING),
            "launch.events.process.ProcessStdin",
            {"from_stdin": True, "from_stdout": False},
        ),
        (
            process.ProcessStdout(text=b"x", action=None, **_RUNNING),
            "launch.events.process.ProcessStdout",
            {"from_stdout": True, "from_stderr": False},
        ),
        (
            process.ProcessStderr(text=b"x", action=None, **_RUNNING),
            "launch.events.process.ProcessStderr",
            {"from_stderr": True, "from_stdout": False},
        ),
        (
            process.SignalProcess(signal_number=signal.SIGUSR1, process_matcher=bool),
            "launch.events.process.SignalProcess",
            {"signal": signal.SIGUSR1, "signal_name": "SIGUSR1", "process_matcher": bool},
        ),
        (
            process.ShutdownProcess(process_matcher=bool),
            "launch.events.process.ShutdownProcess",
            {"process_matcher": bool},
        ),
    ],
)
def test_events_have_names_and_say_what_happened(event: Event, name: str, values: dict[str, Any]) -> None:
    assert event.name == name
    assert {key: getattr(event, key) for key in values} == values


def test_all_names_are_there() -> None:
    for package in (events, process):
        assert all(getattr(package, name) is not None for name in package.__all__)


@pytest.mark.conforms("1.6 process.RunningProcessEvent")
def test_an_event_of_a_process_knows_its_action() -> None:
    action = _process()
    event = process.ProcessStarted(action=action, **_RUNNING)
    assert event.action is event.execute_process_action is action


@pytest.mark.conforms("1.6 process.SignalProcess")
@pytest.mark.parametrize("number", [9, "SIGNONE", None])
def test_a_signal_has_a_name(number: Any) -> None:
    with pytest.raises(TypeError):
        process.SignalProcess(signal_number=number, process_matcher=bool)


@pytest.mark.conforms("1.6 process.SignalProcess")
def test_a_signal_may_be_given_by_its_name() -> None:
    assert process.SignalProcess(signal_number="SIGKILL", process_matcher=bool).signal is signal.SIGKILL


@pytest.mark.conforms("1.6 process.matches_pid", "1.6 process.matches_name", "1.6 process.matches_executable")
@pytest.mark.parametrize(
    ("matcher", "matches"),
    [
        (process.matches_pid(12), True),
        (process.matches_pid(13), False),
        (process.matches_name("ls-1"), True),
        (process.matches_name("ls"), False),
        (process.matches_executable("ls"), True),
        (process.matches_executable("cat"), False),
    ],
)
def test_matchers_compare_the_running_process(matcher: ActionMatcher, *, matches: bool) -> None:
    action = _process()
    assert not matcher(action)
    action._observe(process.ProcessStarted(action=action, **_RUNNING))
    assert matcher(action) is matches


@pytest.mark.conforms("1.6 matches_action")
def test_an_action_matches_itself_alone() -> None:
    action = _process()
    assert events.matches_action(action)(action)
    assert not events.matches_action(action)(_process())
    assert events.matches_action(action).target is action


@pytest.mark.conforms("1.3.2 properties", "1.3.2 events")
def test_a_process_knows_how_it_ended() -> None:
    action = _process()
    action._observe(process.ProcessExited(returncode=3, action=action, **_RUNNING))
    assert action.return_code == 3
    assert action.process_details is not None
    assert action.process_details["pid"] == 12
