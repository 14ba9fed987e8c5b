from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from orchestra.compat.launch import actions as names
from orchestra.compat.launch.action import Action
from orchestra.compat.launch.actions import (
    AppendEnvironmentVariable,
    DeclareBooleanLaunchArgument,
    DeclareLaunchArgument,
    EmitEvent,
    ExecuteLocal,
    ExecuteProcess,
    ForEach,
    ForLoop,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    OpaqueCoroutine,
    OpaqueFunction,
    RegisterEventHandler,
    ResetLaunchConfigurations,
    SetEnvironmentVariable,
    SetLaunchConfiguration,
    Shutdown,
    TimerAction,
    UnsetLaunchConfiguration,
)
from orchestra.compat.launch.conditions import IfCondition
from orchestra.compat.launch.descriptions import Executable
from orchestra.compat.launch.event_handlers import OnProcessExit
from orchestra.compat.launch.events import Shutdown as ShutdownEvent
from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.launch.launch_description import LaunchDescription
from orchestra.compat.launch.substitutions import LaunchConfiguration, TextSubstitution
from orchestra.compat.launch.utilities import perform_substitutions
from tests.compat import plans
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

_ENVIRONMENT = {"PATH": "/usr/bin:/bin", "HOME": "/home/robot", "OLD": "old"}
_JAZZY = [
    "AppendEnvironmentVariable",
    "DeclareLaunchArgument",
    "EmitEvent",
    "ExecuteLocal",
    "ExecuteProcess",
    "GroupAction",
    "IncludeLaunchDescription",
    "LogInfo",
    "OpaqueCoroutine",
    "OpaqueFunction",
    "PopEnvironment",
    "PopLaunchConfigurations",
    "PushEnvironment",
    "PushLaunchConfigurations",
    "RegisterEventHandler",
    "ResetEnvironment",
    "ResetLaunchConfigurations",
    "SetEnvironmentVariable",
    "SetLaunchConfiguration",
    "Shutdown",
    "TimerAction",
    "UnregisterEventHandler",
    "UnsetEnvironmentVariable",
    "UnsetLaunchConfiguration",
]


@pytest.fixture(autouse=True, scope="module")
def _loading() -> Iterator[None]:
    with loading(_ENVIRONMENT):
        yield


async def _coroutine(*_: Any) -> None:
    """Do nothing."""


def _text(subs: Any) -> str:
    return perform_substitutions(LaunchContext(), subs)


@pytest.mark.conforms("1.3 exported names", "1.12.1 later names")
@pytest.mark.parametrize("name", [*_JAZZY, "ForEach", "ForLoop", "LogDebug", "LogWarning", "LogError"])
def test_every_action_is_there(name: str) -> None:
    assert issubclass(getattr(names, name), Action)
    assert name in names.__all__


@pytest.mark.conforms(
    "1.2 Action constructor",
    "1.3.1 no choices",
    "1.3.1 default among the choices",
    "1.3 EmitEvent",
    "1.3 OpaqueCoroutine",
    "1.3.2 cmd",
    "D52",
)
@pytest.mark.parametrize(
    ("make", "error"),
    [
        (lambda: LogInfo(msg="x", colour="red"), TypeError),
        (lambda: LogInfo(msg=5), TypeError),
        (lambda: SetLaunchConfiguration("a", 5), TypeError),
        (lambda: SetEnvironmentVariable("a", None), TypeError),
        (lambda: DeclareLaunchArgument("a", choices=[]), RuntimeError),
        (lambda: DeclareLaunchArgument("a", default_value="x", choices=["y"]), RuntimeError),
        (lambda: DeclareBooleanLaunchArgument("a", default_value="maybe"), RuntimeError),
        (lambda: EmitEvent(event="shutdown"), RuntimeError),
        (lambda: ExecuteProcess(cmd="ls -l"), TypeError),
        (lambda: ExecuteProcess(cmd=LaunchConfiguration("cmd")), TypeError),
        (lambda: ExecuteProcess(cmd=["ls", 5]), TypeError),
        (lambda: ExecuteProcess(cmd=["ls"], env={"A": 1}), TypeError),
        (lambda: ExecuteProcess(cmd=["ls"], respawn=3), TypeError),
        (lambda: ExecuteProcess(["ls"]), TypeError),
        (lambda: OpaqueFunction(function="f"), TypeError),
        (lambda: OpaqueCoroutine(coroutine=print), TypeError),
        (lambda: OpaqueCoroutine(coroutine=_coroutine, kwargs=[1]), TypeError),
        (lambda: OpaqueCoroutine(coroutine=_coroutine, args=1), TypeError),
        (lambda: TimerAction(period=None, actions=[]), TypeError),
        (lambda: TimerAction(period=1.0, actions=LogInfo(msg="x")), TypeError),
        (lambda: RegisterEventHandler(LogInfo(msg="x")), TypeError),
        (lambda: IncludeLaunchDescription(5), TypeError),
    ],
)
def test_what_cannot_be_is_refused_where_it_is_made(make: Callable[[], Any], error: type[Exception]) -> None:
    with pytest.raises(error):
        make()


@pytest.mark.conforms("D16", "D45")
@pytest.mark.parametrize(
    "make",
    [
        lambda: DeclareLaunchArgument("a", default_value=LaunchConfiguration("b"), choices=["y"]),
        lambda: DeclareLaunchArgument("a", default_value=["x"], choices=["y"]),
        lambda: DeclareLaunchArgument("a", default_value=5, choices=["5"]),
        lambda: DeclareBooleanLaunchArgument("a", default_value=True),
        lambda: EmitEvent(event=ShutdownEvent),
        lambda: ExecuteProcess(cmd=["ls"], respawn="true", sigterm_timeout=3),
        lambda: TimerAction(period=1, actions=[], cancel_on_shutdown=LaunchConfiguration("b")),
        lambda: IncludeLaunchDescription("a.launch.py", launch_arguments={"ab": "c"}),
    ],
)
def test_what_is_plainly_meant_is_taken(make: Callable[[], Any]) -> None:
    assert isinstance(make(), Action)


@pytest.mark.conforms("1.3.2 properties", "1.3.2 sigterm_timeout")
def test_a_process_tells_what_it_was_given() -> None:
    process = ExecuteProcess(  # noqa: S604 - it is not started
        cmd=["ls", ["-", TextSubstitution(text="l")]],
        name="list",
        cwd="/",
        env={"A": "1"},
        additional_env={"B": LaunchConfiguration("b", default="2")},
        shell=True,
        emulate_tty=True,
        output="screen",
        sigterm_timeout="7",
    )
    assert [_text(word) for word in process.cmd] == ["ls", "-l"]
    assert (_text(process.name), _text(process.cwd), _text(process.output)) == ("list", "/", "screen")
    assert [(_text(name), _text(value)) for name, value in process.env] == [("A", "1")]
    assert [(_text(name), _text(value)) for name, value in process.additional_env] == [("B", "2")]
    assert process.shell is True
    assert process.emulate_tty is True
    assert _text(process.sigterm_timeout) == "7"
    assert _text(process.sigkill_timeout) == "5"
    assert process.process_details is None
    assert process.return_code is None


@pytest.mark.conforms("1.3.2 properties")
def test_a_process_that_was_told_nothing_has_the_usual_values() -> None:
    process = ExecuteProcess(cmd=["ls"])
    assert (process.name, process.cwd, process.env, process.additional_env) == (None, None, None, None)
    assert (process.shell, process.emulate_tty, _text(process.output)) == (False, False, "log")
    assert _text(process.process_description.prefix) == ""


@pytest.mark.conforms("1.3.2 properties", "1.3.2 prefix", "D35", "D53")
def test_a_prepared_process_has_texts() -> None:
    context = LaunchContext()
    context.launch_configurations["launch-prefix"] = "gdb -ex 'run now'"
    one, other = (ExecuteProcess(cmd=["/bin/ls"], additional_env={"A": "1"}, cwd="/") for _ in range(2))
    one.prepare(context)
    other.prepare(context)
    assert one.cmd == ["gdb", "-ex", "run now", "/bin/ls"]
    assert (one.name, other.name, one.cwd) == ("ls-1", "ls-2", "/")
    assert one.env["A"] == "1"
    assert one.env["OLD"] == "old"
    assert one.process_details is not None
    assert "pid" not in one.process_details


@pytest.mark.conforms("1.3.2 launch-prefix-filter", "1.3.2 Executable")
def test_the_prefix_of_all_processes_is_for_those_that_the_filter_chooses() -> None:
    context = LaunchContext()
    context.launch_configurations.update({"launch-prefix": "gdb", "launch-prefix-filter": "tal"})
    found = []
    for program in ("/bin/talker", "/bin/listener"):
        executable = Executable(cmd=[program], arguments=["x"])
        executable.prepare(context, None)
        found.append(executable.final_cmd)
    assert found == [["gdb", "/bin/talker", "x"], ["/bin/listener", "x"]]


@pytest.mark.conforms("1.3.2 cached_output")
def test_output_is_only_kept_where_that_was_asked_for() -> None:
    with pytest.raises(RuntimeError, match="cached_output"):
        ExecuteProcess(cmd=["ls"]).get_stdout()
    assert ExecuteProcess(cmd=["ls"], cached_output=True).get_stderr() == ""


@pytest.mark.conforms("1.3.2 output", "4.10 OVERRIDE_LAUNCH_PROCESS_OUTPUT")
def test_an_environment_variable_stands_for_every_output(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OVERRIDE_LAUNCH_PROCESS_OUTPUT", "full")
    assert _text(ExecuteProcess(cmd=["ls"], output="log").output) == "full"


@pytest.mark.conforms("1.3.2 on_exit", "1.2 Action.get_sub_entities")
def test_what_follows_the_end_of_a_process_is_known_where_it_is_a_list() -> None:
    follows = [LogInfo(msg="x")]
    assert ExecuteProcess(cmd=["ls"], on_exit=follows).get_sub_entities() == follows
    assert ExecuteProcess(cmd=["ls"], on_exit=print).get_sub_entities() == []


@pytest.mark.conforms(
    "1.3.1 no description", "1.3.1 choices without a description", "1.3.1 choices with a description"
)
@pytest.mark.parametrize(
    ("arguments", "description"),
    [
        ({}, "no description given"),
        ({"description": "What."}, "What."),
        ({"choices": ["a", "b"]}, "One of: ['a', 'b']"),
        ({"description": "What", "choices": ["a"]}, "What. Valid choices are: ['a']"),
        ({"description": "What.", "choices": ["a"]}, "What. Valid choices are: ['a']"),
    ],
)
def test_an_argument_describes_its_choices(arguments: dict[str, Any], description: str) -> None:
    assert DeclareLaunchArgument("x", **arguments).description == description


@pytest.mark.conforms(
    "1.2 LaunchDescription.get_launch_arguments",
    "1.2 LaunchDescription.get_launch_arguments_with_include_launch_description_actions",
    "1.2 Action.get_sub_entities",
)
def test_arguments_are_found_without_a_visit(tmp_path: Path) -> None:
    inner = plans.write(
        tmp_path / "inner.launch.py", "DeclareLaunchArgument('inside'), DeclareLaunchArgument('a')"
    )
    first = DeclareLaunchArgument("a")
    description = LaunchDescription(
        [
            first,
            DeclareLaunchArgument("conditional", condition=IfCondition("true")),
            GroupAction([DeclareLaunchArgument("grouped")], condition=IfCondition("true")),
            IncludeLaunchDescription(str(inner)),
            RegisterEventHandler(OnProcessExit(on_exit=[DeclareLaunchArgument("later")])),
            TimerAction(period=1.0, actions=[DeclareLaunchArgument("timed")]),
            ResetLaunchConfigurations(),
            DeclareLaunchArgument("behind"),
        ]
    )
    found = description.get_launch_arguments_with_include_launch_description_actions()
    conditions = {argument.name: argument._conditionally_included for argument, _ in found}
    assert conditions == {
        "a": False,
        "conditional": True,
        "grouped": True,
        "inside": False,
        "later": True,
        "timed": True,
    }
    ways = {argument.name: includes for argument, includes in found}
    assert ways["a"] is None
    assert [include.describe() for include in ways["inside"] or ()] == [
        f"IncludeLaunchDescription('{inner}')"
    ]
    assert found[0][0] is first


@pytest.mark.conforms("1.3 TimerAction")
def test_a_timer_can_be_cancelled_before_it_is_visited(tmp_path: Path) -> None:
    before = "timer = TimerAction(period=1.0, actions=[LogInfo(msg='x')])\ntimer.cancel()\n"
    assert plans.python(tmp_path, "timer", before).triggers == []


_SAME: list[tuple[str, list[dict[str, Any]]]] = [
    (
        "DeclareLaunchArgument('a', default_value='1', description='What', choices=['1', '2'])",
        [{"arg": {"name": "a", "default": "1", "description": "What", "choices": ["1", "2"]}}],
    ),
    ("LogInfo(msg=['a', EnvironmentVariable('OLD')])", [{"log": {"message": "a$(env OLD)"}}]),
    (
        "ExecuteProcess(cmd=['echo', ['a b', LC('x', default='c')]])",
        [{"executable": {"cmd": "echo 'a b$(var x c)'"}}],
    ),
    (
        "ExecuteProcess(cmd=['echo'], name='n', cwd='/', shell=True, emulate_tty=True, output='screen', "
        "additional_env={'A': 'b'}, prefix='time -p', respawn=True, respawn_delay=2.0, respawn_max_retries=3, "
        "sigterm_timeout='7', sigkill_timeout='8')",
        [
            {
                "executable": {
                    "cmd": "echo",
                    "name": "n",
                    "cwd": "/",
                    "shell": True,
                    "emulate_tty": True,
                    "output": "screen",
                    "env": [{"name": "A", "value": "b"}],
                    "launch-prefix": "time -p",
                    "respawn": True,
                    "respawn_delay": 2.0,
                    "respawn_max_retries": 3,
                    "sigterm_timeout": 7,
                    "sigkill_timeout": 8,
                }
            }
        ],
    ),
    (
        "ExecuteProcess(cmd=['echo'], on_exit=Shutdown())",
        [{"executable": {"cmd": "echo", "on_exit": "shutdown"}}],
    ),
    (
        "ExecuteProcess(cmd=['echo'], on_exit=[Shutdown()])",
        [{"executable": {"cmd": "echo", "on_exit": "shutdown"}}],
    ),
    (
        "ExecuteProcess(cmd=['echo'], output={'stdout': 'screen', 'stderr': {'log', 'own_log'}})",
        [{"executable": {"cmd": "echo", "output": {"stdout": "screen", "stderr": ["log", "own_log"]}}}],
    ),
    ("ExecuteProcess(cmd=['echo'], output={})", [{"executable": {"cmd": "echo", "output": {"both": []}}}]),
    (
        "ExecuteLocal(process_description=Executable(cmd=['echo'], arguments=['a']))",
        [{"executable": {"cmd": "echo a"}}],
    ),
    (
        "GroupAction([SetLaunchConfiguration('a', '1'), LogInfo(msg=LC('a'))]), LogInfo(msg=LC('a', default='0'))",
        [
            {"group": [{"let": {"name": "a", "value": "1"}}, {"log": {"message": "$(var a)"}}]},
            {"log": {"message": "$(var a 0)"}},
        ],
    ),
    (
        "GroupAction([LogInfo(msg=LC('k'))], forwarding=False, launch_configurations={'k': 'v'})",
        [
            {
                "group": {
                    "forwarding": False,
                    "keep": [{"name": "k", "value": "v"}],
                    "children": [{"log": {"message": "$(var k)"}}],
                }
            }
        ],
    ),
    (
        "SetEnvironmentVariable('A', '1'), AppendEnvironmentVariable('OLD', 'new', prepend=True, separator=';'), "
        "UnsetEnvironmentVariable('HOME'), ExecuteProcess(cmd=['echo'])",
        [
            {"set_env": {"name": "A", "value": "1"}},
            {"append_env": {"name": "OLD", "value": "new", "prepend": True, "separator": ";"}},
            {"unset_env": {"name": "HOME"}},
            {"executable": {"cmd": "echo"}},
        ],
    ),
    (
        "SetEnvironmentVariable('A', '1'), ResetEnvironment(), ExecuteProcess(cmd=['echo'])",
        [{"set_env": {"name": "A", "value": "1"}}, {"reset_env": {}}, {"executable": {"cmd": "echo"}}],
    ),
    (
        "SetLaunchConfiguration('a', '1'), ResetLaunchConfigurations({'b': LC('a')}), LogInfo(msg=[LC('a', default='0'), LC('b')])",
        [
            {"let": {"name": "a", "value": "1"}},
            {"reset": {"keep": [{"name": "b", "value": "$(var a)"}]}},
            {"log": {"message": "$(var a 0)$(var b)"}},
        ],
    ),
    (
        "TimerAction(period=2.0, actions=[LogInfo(msg='x')], cancel_on_shutdown=False)",
        [{"timer": {"period": 2, "cancel_on_shutdown": False, "children": [{"log": {"message": "x"}}]}}],
    ),
    (
        "ExecuteProcess(cmd=['echo'], respawn=LC('r', default='true'), respawn_delay=-1)",
        [{"executable": {"cmd": "echo", "respawn": "$(var r true)", "respawn_delay": 0}}],
    ),
    ("Shutdown(reason='done')", [{"shutdown": {"reason": "done"}}]),
    ("Shutdown()", [{"shutdown": {}}]),
    ("LogWarning(msg='x')", [{"log": {"message": "x", "level": "warning"}}]),
    ("LogInfo(msg='x', condition=UnlessCondition('true'))", [{"log": {"message": "x", "unless": True}}]),
    (
        "IncludeLaunchDescription('inner.launch.py', launch_arguments={'a': LC('x', default='7')}.items())",
        [{"include": {"file": "inner.launch.py", "arg": [{"name": "a", "value": "$(var x 7)"}]}}],
    ),
    (
        "IncludeLaunchDescription(PythonLaunchDescriptionSource('inner.launch.py'), launch_arguments=[('a', '7')], "
        "condition=IfCondition('true'))",
        [{"include": {"file": "inner.launch.py", "arg": [{"name": "a", "value": "7"}], "if": True}}],
    ),
]


@pytest.mark.conforms(
    "1.3 AppendEnvironmentVariable",
    "1.3 DeclareLaunchArgument",
    "1.3 ExecuteLocal",
    "1.3 ExecuteProcess",
    "1.3 GroupAction",
    "1.3 IncludeLaunchDescription",
    "1.3 LogInfo",
    "1.3 ResetEnvironment",
    "1.3 ResetLaunchConfigurations",
    "1.3 SetEnvironmentVariable",
    "1.3 SetLaunchConfiguration",
    "1.3 Shutdown",
    "1.3 TimerAction",
    "1.3 UnsetEnvironmentVariable",
    "1.3.2 cmd",
    "1.3.2 name",
    "1.3.2 cwd",
    "1.3.2 additional_env",
    "1.3.2 shell",
    "1.3.2 emulate_tty",
    "1.3.2 output",
    "1.3.2 respawn",
    "1.3.2 respawn_delay",
    "1.3.2 respawn_max_retries",
    "1.3.2 sigterm_timeout",
)
@pytest.mark.parametrize(("actions", "written"), _SAME)
def test_what_is_written_in_python_and_in_yaml_is_the_same_plan(
    actions: str, written: list[dict[str, Any]], tmp_path: Path
) -> None:
    plans.write(tmp_path / "inner.launch.py", "DeclareLaunchArgument('a'), LogInfo(msg=LC('a'))")
    from_python, from_yaml = plans.python(tmp_path, actions), plans.yaml(tmp_path, written)
    assert from_python == from_yaml
    assert not from_python.problems


_SCOPES = [
    ("SetLaunchConfiguration('a', '1'), UnsetLaunchConfiguration('a'), LogInfo(msg=LC('a', default='0'))", ["0"]),
    ("PushLaunchConfigurations(), SetLaunchConfiguration('a', '1'), LogInfo(msg=LC('a')), PopLaunchConfigurations(), "
     "LogInfo(msg=LC('a', default='0'))", ["1", "0"]),
    ("PushEnvironment(), SetEnvironmentVariable('OLD', '1'), LogInfo(msg=EnvironmentVariable('OLD')), PopEnvironment(), "
     "LogInfo(msg=EnvironmentVariable('OLD'))", ["1", "old"]),
    ("GroupAction([], scoped=False, launch_configurations={'a': '1'}), LogInfo(msg=LC('a'))", ["1"]),
    ("SetLaunchConfiguration('t', 'x'), GroupAction([LogInfo(msg=[LC('t', default='-'), LC('k')])], forwarding=False, "
     "launch_configurations={'k': LC('t')})", ["-x"]),
    ("OpaqueFunction(function=lambda context, n, more: context.launch_configurations.update(a=n + more), args=['1'], "
     "kwargs={'more': '2'}), LogInfo(msg=LC('a'))", ["12"]),
    ("OpaqueFunction(function=lambda context: [LogInfo(msg='first')]), LogInfo(msg='second')", ["first", "second"]),
    ("SetLaunchConfiguration('robots', '{name: a, id: 1};{name: b, id: 2}'), "
     "ForEach(LC('robots'), function=lambda name, id: [LogInfo(msg=name + str(id))])", ["a1", "b2"]),
    ("ForLoop('2', function=lambda i: [LogInfo(msg=str(i))])", ["0", "1"]),
    ("LogInfo(msg='$(var literal)')", ["$(var literal)"]),
]  # fmt: skip


@pytest.mark.conforms(
    "1.1 texts are literal",
    "1.3 PushEnvironment",
    "1.3 PopEnvironment",
    "1.3 PushLaunchConfigurations",
    "1.3 PopLaunchConfigurations",
    "1.3 UnsetLaunchConfiguration",
    "1.3 OpaqueFunction",
    "1.3 GroupAction",
    "4.2 scoped without forwarding",
    "4.2 not scoped",
    "1.12.1 later names",
)
@pytest.mark.parametrize(("actions", "messages"), _SCOPES)
def test_actions_do_what_they_say(actions: str, messages: list[str], tmp_path: Path) -> None:
    found = plans.python(tmp_path, actions)
    assert found.messages == messages
    assert not found.problems


_SUBCLASSES = """
class Late(ExecuteProcess):
    def __init__(self, words, **kwargs):
        super().__init__(cmd=words, **kwargs)
    def execute(self, context):
        self.cmd.append([LC('a')])
        return super().execute(context)

class Twice(GroupAction):
    def get_sub_entities(self):
        return [*super().get_sub_entities(), *super().get_sub_entities()]

class Before(IncludeLaunchDescription):
    def execute(self, context):
        context.launch_configurations['a'] = 'from before'
        return super().execute(context)

class Message(Action):
    def __init__(self, text, **kwargs):
        super().__init__(**kwargs)
        self.text = text
    def execute(self, context):
        return [LogInfo(msg=[self.text, LC('a')])]

class Visited(LogInfo):
    def visit(self, context):
        context.launch_configurations['a'] = 'visited'
        return super().visit(context)

class Declared(DeclareLaunchArgument):
    pass
"""


@pytest.mark.conforms("1.2 Action.visit", "1.2 Action.execute")
@pytest.mark.parametrize(
    ("actions", "commands", "messages"),
    [
        ("Late(['echo'])", [["echo", "1"]], []),
        ("Late(['echo'], condition=UnlessCondition(LC('a')))", [], []),
        ("Twice([LogInfo(msg='x')])", [], ["x", "x"]),
        ("Message('is '), Message('not', condition=IfCondition('false'))", [], ["is 1"]),
        ("Visited(msg=['see ', LC('a')])", [], ["see visited"]),
        ("Before('inner.launch.py')", [], ["from before"]),
        ("Declared('a', default_value='2'), LogInfo(msg=LC('a'))", [], ["1"]),
    ],
)
def test_subclasses_of_users_do_what_their_code_says(
    actions: str, commands: list[list[str]], messages: list[str], tmp_path: Path
) -> None:
    plans.write(tmp_path / "inner.launch.py", "LogInfo(msg=LC('a'))")
    found = plans.python(tmp_path, f"SetLaunchConfiguration('a', '1'), {actions}", _SUBCLASSES)
    assert (found.commands, found.messages, found.problems) == (commands, messages, [])


@pytest.mark.conforms(
    "1.3.1 no default", "1.3.1 value that is no choice", "1.3 PopEnvironment", "4.10 by stream"
)
@pytest.mark.parametrize(
    ("actions", "message"),
    [
        ("DeclareLaunchArgument('needed')", "needed"),
        ("DeclareLaunchArgument('a', default_value=['x'], choices=['y'])", "'x'"),
        ("ExecuteProcess(cmd=['echo'], output='nowhere')", "nowhere"),
        ("ExecuteProcess(cmd=['echo'], output={'stdout': 'nowhere'})", "nowhere"),
        ("OpaqueFunction(function=lambda context: 1 / 0)", "ZeroDivisionError"),
        ("PopEnvironment()", "no environment has been pushed"),
    ],
)
def test_what_goes_wrong_in_a_visit_is_said(actions: str, message: str, tmp_path: Path) -> None:
    (problem,) = plans.python(tmp_path, actions).problems
    assert message in problem


@pytest.mark.conforms("1.3 OpaqueCoroutine")
def test_a_coroutine_runs_during_the_run(tmp_path: Path) -> None:
    (trigger,) = plans.python(
        tmp_path, "OpaqueCoroutine(coroutine=c)", "async def c(context): raise AssertionError"
    ).triggers
    assert (trigger["on"]["event"], trigger["deferred"]) == ("run_started", True)


@pytest.mark.conforms("1.3 OpaqueCoroutine")
def test_a_coroutine_gets_its_arguments() -> None:
    seen = []

    async def noted(*args: Any, **kwargs: Any) -> None:
        seen.append((args, kwargs))

    for ignoring in (True, False):
        action = OpaqueCoroutine(coroutine=noted, args=[1], kwargs={"b": 2}, ignore_context=ignoring)
        (child,) = action._to_model({}).children
        context = LaunchContext()
        child.target.execute(context)
        assert seen.pop() == ((1,) if ignoring else (context, 1), {"b": 2})


def test_kinds_of_actions_are_what_users_ask_for() -> None:
    assert isinstance(ExecuteProcess(cmd=["ls"]), ExecuteLocal)
    assert isinstance(Shutdown().event, ShutdownEvent)
    assert AppendEnvironmentVariable("A", "b").prepend is False
    assert UnsetLaunchConfiguration("a").name[0].describe() == "'a'"
    assert [_text(ForEach("a", function=print).input_values), _text(ForLoop("3", function=print).length)] == [
        "a",
        "3",
    ]
