from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from orchestra.compat.launch import event_handlers as names
from orchestra.compat.launch.action import Action
from orchestra.compat.launch.actions import (
    ExecuteLocal,
    ExecuteProcess,
    LogInfo,
    OpaqueFunction,
    RegisterEventHandler,
)
from orchestra.compat.launch.descriptions import Executable
from orchestra.compat.launch.event_handler import BaseEventHandler, EventHandler
from orchestra.compat.launch.event_handlers import (
    OnActionEventBase,
    OnExecutionComplete,
    OnIncludeLaunchDescription,
    OnProcessExit,
    OnProcessIO,
    OnProcessStart,
    OnShutdown,
    event_named,
)
from orchestra.compat.launch.events import ExecutionComplete, IncludeLaunchDescription, Shutdown
from orchestra.compat.launch.events.process import (
    ProcessExited,
    ProcessIO,
    ProcessStarted,
    ProcessStderr,
    ProcessStdin,
    ProcessStdout,
)
from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.launch.launch_description import LaunchDescription
from tests.compat import plans
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from orchestra.compat.launch.event import Event

_PROCESS = ExecuteProcess(cmd=["ls"])
_OTHER = ExecuteProcess(cmd=["ls"])
_RUNNING: dict[str, Any] = {"name": "ls-1", "cmd": ["ls"], "cwd": None, "env": {}, "pid": 12}
_EXITED = ProcessExited(action=_PROCESS, returncode=0, **_RUNNING)
_STARTED = ProcessStarted(action=_PROCESS, **_RUNNING)
_WROTE = ProcessStdout(action=_PROCESS, text=b"ready", **_RUNNING)
_DONE = ExecutionComplete(action=_PROCESS)
_LOG = LogInfo(msg="x")


def _following(*_: Any) -> list[LogInfo]:
    return [_LOG]


def _nothing(*_: Any) -> None:
    """Return nothing."""


@pytest.fixture(autouse=True, scope="module")
def _loading() -> Iterator[None]:
    with loading({"PATH": "/usr/bin:/bin"}):
        yield


def test_all_names_are_there() -> None:
    assert all(callable(getattr(names, name)) for name in names.__all__)


@pytest.mark.conforms(
    "1.7 OnExecutionComplete",
    "1.7 OnProcessStart",
    "1.7 OnProcessExit",
    "1.7 OnProcessIO",
    "1.7 OnShutdown",
    "1.7 OnIncludeLaunchDescription",
    "1.7 event_named",
    "1.7 target_action",
    "1.7 EventHandler",
)
@pytest.mark.parametrize(
    ("handler", "event", "matches"),
    [
        (OnProcessExit(on_exit=_LOG), _EXITED, True),
        (OnProcessExit(on_exit=_LOG), _STARTED, False),
        (OnProcessExit(target_action=_PROCESS, on_exit=_LOG), _EXITED, True),
        (OnProcessExit(target_action=_OTHER, on_exit=_LOG), _EXITED, False),
        (OnProcessExit(target_action=lambda action: action is _PROCESS, on_exit=_LOG), _EXITED, True),
        (OnProcessExit(target_action=_nothing, on_exit=_LOG), _EXITED, False),
        (OnProcessStart(target_action=_PROCESS, on_start=_LOG), _STARTED, True),
        (OnProcessIO(target_action=_PROCESS, on_stdout=print), _WROTE, True),
        (OnProcessIO(target_action=_OTHER, on_stdout=print), _WROTE, False),
        (OnExecutionComplete(target_action=_PROCESS, on_completion=_LOG), _DONE, True),
        (OnExecutionComplete(target_action=_LOG, on_completion=_LOG), _DONE, False),
        (OnShutdown(on_shutdown=_LOG), Shutdown(), True),
        (OnShutdown(on_shutdown=_LOG), _EXITED, False),
        (OnIncludeLaunchDescription(), IncludeLaunchDescription(LaunchDescription()), True),
        (OnIncludeLaunchDescription(), Shutdown(), False),
        (EventHandler(matcher=event_named("launch.events.Shutdown")), Shutdown(), True),
        (EventHandler(matcher=event_named("launch.events.Shutdown")), _EXITED, False),
    ],
)
def test_handlers_want_their_events(handler: BaseEventHandler, event: Event, *, matches: bool) -> None:
    assert handler.matches(event) is matches


@pytest.mark.conforms("1.7 target_action", "1.7 OnActionEventBase")
@pytest.mark.parametrize(
    "make",
    [
        lambda: OnProcessExit(target_action="ls", on_exit=_LOG),
        lambda: OnProcessExit(target_action=_LOG, on_exit=_LOG),
        lambda: OnProcessExit(on_exit=[_LOG, "more"]),
        lambda: OnProcessExit(on_exit=5),
        OnProcessExit,
        lambda: OnProcessStart(
            target_action=ExecuteLocal(process_description=Executable(cmd=["ls"])), on_start=_LOG
        ),
        lambda: OnShutdown(on_shutdown=["x"]),
        lambda: OnProcessIO(target_action="ls"),
        lambda: OnActionEventBase(
            action_matcher=None, on_event=_LOG, target_event_cls=LogInfo, target_action_cls=Action
        ),
        lambda: OnShutdown(on_shutdown=_LOG, once=True),
    ],
)
def test_what_cannot_be_is_refused_where_it_is_made(make: Callable[[], Any]) -> None:
    with pytest.raises(TypeError):
        make()


@pytest.mark.conforms("1.7 what a handler returns", "1.7 BaseEventHandler", "1.7 EventHandler")
@pytest.mark.parametrize(
    ("handler", "event"),
    [
        (OnProcessExit(on_exit=_LOG), _EXITED),
        (OnProcessExit(on_exit=(_LOG,)), _EXITED),
        (OnProcessExit(on_exit=_following), _EXITED),
        (OnProcessStart(on_start=[_LOG]), _STARTED),
        (OnExecutionComplete(on_completion=[_LOG]), _DONE),
        (OnShutdown(on_shutdown=_LOG), Shutdown()),
        (OnShutdown(on_shutdown=_following), Shutdown()),
        (OnProcessIO(on_stdout=_following), _WROTE),
        (EventHandler(matcher=bool, entities=[_LOG]), Shutdown()),
    ],
)
def test_handling_gives_what_follows_and_makes_the_event_known(
    handler: BaseEventHandler, event: Event
) -> None:
    context = LaunchContext()
    assert list(handler.handle(event, context)) == [_LOG]
    assert context.locals.event is event


@pytest.mark.conforms("1.7 OnProcessIO")
def test_output_is_handled_by_stream() -> None:
    seen = []
    handler = OnProcessIO(
        on_stdin=lambda event: seen.append(("in", event.text)),
        on_stdout=lambda event: seen.append(("out", event.text)),
        on_stderr=lambda event: seen.append(("err", event.text)),
    )
    for kind in (ProcessStdin, ProcessStdout, ProcessStderr):
        handler.handle(kind(action=_PROCESS, text=b"x", **_RUNNING), LaunchContext())
    assert seen == [("in", b"x"), ("out", b"x"), ("err", b"x")]


@pytest.mark.conforms("1.7 OnIncludeLaunchDescription")
def test_a_description_that_an_event_brings_is_visited() -> None:
    description = LaunchDescription()
    event = IncludeLaunchDescription(description)
    assert OnIncludeLaunchDescription().handle(event, LaunchContext()) == [description]


@pytest.mark.conforms("1.7 handle_once", "1.2 LaunchContext.would_handle_event")
def test_a_handler_for_one_event_is_no_longer_registered_after_it() -> None:
    context = LaunchContext()
    handler = OnShutdown(on_shutdown=_LOG, handle_once=True)
    context.register_event_handler(handler)
    assert context.would_handle_event(Shutdown())
    handler.handle(Shutdown(), context)
    assert not context.would_handle_event(Shutdown())


def test_handlers_describe_what_follows() -> None:
    text, entities = OnProcessExit(target_action=_PROCESS, on_exit=[_LOG]).describe()
    assert text == (
        "OnProcessExit(matcher='event == ProcessExited and ExecuteLocal(event.action)', "
        "handler='<actions>', handle_once=False)"
    )
    assert entities == [_LOG]
    assert OnShutdown(on_shutdown=_nothing).describe()[1] == []
    assert EventHandler(matcher=bool, entities=_LOG).describe()[1] == [_LOG]


class _Counting(OnProcessExit):
    def handle(self, event: Event, context: LaunchContext) -> Any:
        return super().handle(event, context)


class _Choosing(OnProcessExit):
    def matches(self, event: Event) -> bool:
        return super().matches(event)


class _Own(BaseEventHandler):
    pass


@pytest.mark.parametrize(
    ("handler", "expected"),
    [
        (OnProcessExit(target_action=_PROCESS, on_exit=[_LOG]), [("process_exited", None, 1)]),
        (OnProcessExit(on_exit=_nothing), [("process_exited", None, None)]),
        (OnProcessStart(on_start=[_LOG, _LOG]), [("process_started", None, 2)]),
        (OnExecutionComplete(on_completion=_LOG), [("process_completed", None, 1)]),
        (OnShutdown(on_shutdown=_LOG), [("shutdown", None, 1)]),
        (
            OnProcessIO(on_stdout=print, on_stderr=print),
            [("process_output", "stdout", None), ("process_output", "stderr", None)],
        ),
        (OnIncludeLaunchDescription(), [("custom", None, None)]),
        (EventHandler(matcher=bool, entities=_LOG), [("custom", None, 1)]),
        (_Counting(on_exit=[_LOG]), [("process_exited", None, None)]),
        (_Choosing(on_exit=[_LOG]), [("custom", None, 1)]),
        (_Own(matcher=bool), [("custom", None, None)]),
        (
            OnActionEventBase(
                action_matcher=None, on_event=_LOG, target_event_cls=ProcessIO, target_action_cls=Action
            ),
            [("process_output", "stdout", 1), ("process_output", "stderr", 1)],
        ),
    ],
)
def test_a_model_says_what_can_be_known_before_the_run(
    handler: BaseEventHandler, expected: list[tuple[str, str | None, int | None]]
) -> None:
    models = handler._to_models()
    found = [
        (model.event, model.stream, None if model.children is None else len(model.children))
        for model in models
    ]
    assert found == expected
    assert all(model.origin is handler for model in models)
    assert all((model.callback is None) == (model.children is not None) for model in models)
    assert {model.span.file for model in models} == {"tests/compat/test_event_handlers.py"}


@pytest.mark.conforms("1.3.2 on_exit", "1.3.2 cached_output")
def test_the_handlers_of_a_process_are_registered_before_it() -> None:
    process = ExecuteProcess(cmd=["ls"], on_exit=[_LOG], cached_output=True)
    group: Any = process._to_model({"origin": process})
    register, executable = group.children
    assert [(handler.event, handler.stream) for handler in register.handlers] == [
        ("process_exited", None),
        ("process_output", "stdout"),
        ("process_output", "stderr"),
    ]
    assert all(handler.target is process for handler in register.handlers)
    assert executable.origin is process


@pytest.mark.conforms("1.3.2 cached_output", "1.3.2 events")
def test_kept_output_is_what_came_through_the_streams() -> None:
    process = ExecuteProcess(cmd=["ls"], cached_output=True)
    group: Any = process._to_model({})
    out, err = group.children[0].handlers
    for handler, kind, text in (
        (out, ProcessStdout, "grü".encode()),
        (err, ProcessStderr, b"x"),
        (out, ProcessStdout, b"n"),
    ):
        handler.callback(kind(action=process, text=text, **_RUNNING), LaunchContext())
    assert (process.get_stdout(), process.get_stderr()) == ("grün", "x")


_HEAD = """
process = ExecuteProcess(cmd=['first'])
node = ExecuteProcess(cmd=['second'])
handler = OnProcessExit(target_action=process, on_exit=[LogInfo(msg='gone')])
class Custom(Event):
    name = 'custom'
"""


@pytest.mark.conforms(
    "1.3 RegisterEventHandler",
    "1.3 EmitEvent",
    "4.12 after a start",
    "4.12 after an end",
    "4.12 on output",
    "4.12 any action",
    "4.12 everything down",
    "4.12 at shutdown",
    "4.12 stop one process",
    "1.3.2 events",
)
@pytest.mark.parametrize(
    ("actions", "event", "steps"),
    [
        ("RegisterEventHandler(OnProcessExit(target_action=process, on_exit=[node]))", ("process_exited", "first"), ["start"]),
        ("RegisterEventHandler(OnProcessStart(target_action=process, on_start=node))", ("process_started", "first"), ["start"]),
        ("RegisterEventHandler(OnProcessExit(on_exit=[Shutdown()]))", ("process_exited", None), ["shutdown"]),
        ("RegisterEventHandler(OnShutdown(on_shutdown=[LogInfo(msg='x')]))", ("shutdown", None), ["log"]),
        (
            "RegisterEventHandler(OnExecutionComplete(target_action=process, on_completion=[EmitEvent(event=events.Shutdown(reason='x'))]))",
            ("process_completed", "first"),
            ["shutdown"],
        ),
        ("RegisterEventHandler(OnProcessIO(target_action=process, on_stdout=lambda event: None))", ("process_output", "first"), ["deferred"]),
        ("EmitEvent(event=ShutdownProcess(process_matcher=matches_action(process)))", ("run_started", None), ["stop"]),
        (
            "TimerAction(period=1.0, actions=[EmitEvent(event=SignalProcess(signal_number='SIGUSR1', process_matcher=matches_executable('first')))])",
            ("run_started", None),
            ["signal"],
        ),
    ],
)  # fmt: skip
def test_event_handlers_become_triggers(
    actions: str, event: tuple[str, str | None], steps: list[str], tmp_path: Path
) -> None:
    found = plans.python(tmp_path, f"process, {actions}", _HEAD)
    assert not found.problems
    (trigger,) = found.triggers
    assert (trigger["on"]["event"], trigger["on"]["target"]) == event
    assert [step["action"] for step in trigger["do"]] == steps


@pytest.mark.conforms("1.3 UnregisterEventHandler")
def test_a_handler_that_is_unregistered_again_is_not_in_the_plan(tmp_path: Path) -> None:
    actions = "process, RegisterEventHandler(handler), UnregisterEventHandler(handler)"
    assert plans.python(tmp_path, actions, _HEAD).triggers == []


@pytest.mark.conforms("1.3 UnregisterEventHandler")
def test_to_unregister_what_is_not_registered_is_an_error(tmp_path: Path) -> None:
    assert plans.python(tmp_path, "UnregisterEventHandler(handler)", _HEAD).problems


@pytest.mark.conforms("1.3 EmitEvent", "1.7 EventHandler")
def test_events_of_users_reach_their_handlers_after_the_visit(tmp_path: Path) -> None:
    actions = (
        "RegisterEventHandler(EventHandler(matcher=event_named('custom'), entities=[LogInfo(msg='handled')])), "
        "EmitEvent(event=Custom()), LogInfo(msg='before')"
    )
    assert plans.python(tmp_path, actions, _HEAD).messages == ["before", "handled"]


def test_a_registered_handler_shows_what_may_follow() -> None:
    follows = OpaqueFunction(function=_nothing)
    ((text, entities),) = RegisterEventHandler(
        OnProcessExit(on_exit=[follows])
    ).describe_conditional_sub_entities()
    assert text.startswith("OnProcessExit(")
    assert list(entities) == [follows]
    silent = OnProcessExit(on_exit=_nothing)
    assert RegisterEventHandler(silent).describe_conditional_sub_entities() == []


@pytest.mark.parametrize("target", ["5", "None", "['first']", "LaunchConfiguration('x')", "(1,)"])
@pytest.mark.parametrize("matcher", ["executable", "name", "pid"])
def test_what_is_no_text_matches_no_process(matcher: str, target: str, tmp_path: Path) -> None:
    event = f"EmitEvent(event=ShutdownProcess(process_matcher=matches_{matcher}({target})))"
    found = plans.python(tmp_path, f"process, {event}", _HEAD)
    assert [step["processes"] for trigger in found.triggers for step in trigger["do"]] in ([], [[]])
