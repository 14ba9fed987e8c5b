"""What the launch language says of order, scopes, includes, names and events, asked of Python launch files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from tests.compat import plans
from tests.conformance.marks import conforming

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from tests.compat.plans import Planned

_BEFORE = """
import signal
from typing import List
from launch_ros.actions import *
from launch_ros.descriptions import *

class Custom(Event):
    name = 'custom'

class Counted(Substitution):
    count = 0
    def perform(self, context):
        Counted.count += 1
        return str(Counted.count)

class Once(Condition):
    def evaluate(self, context):
        assert not hasattr(self, 'done')
        self.done = True
        return True

on_custom = lambda *entities: RegisterEventHandler(EventHandler(matcher=event_named('custom'), entities=list(entities)))
process = ExecuteProcess(cmd=['a'])
say = lambda name: LogInfo(msg=LC(name, default='none'))
node = lambda name='n', **keywords: Node(executable='/bin/true', name=name, **keywords)
read = lambda name: OpaqueFunction(function=lambda context: [LogInfo(msg=repr(context.launch_configurations.get(name)))])
logged = LogInfo(msg='logged')
timer = TimerAction(period=1.5, actions=[LogInfo(msg='timed')])
described = LaunchDescription([LogInfo(msg='inner')])
"""


def _messages(plan: Planned) -> Any:
    return plan.messages


def _problems(plan: Planned) -> Any:
    return plan.problems


def _ids(plan: Planned) -> Any:
    return [process["id"] for process in plan.content["processes"]]


def _of(*keys: str) -> Callable[[Planned], Any]:
    return lambda plan: [[process[key] for key in keys] for process in plan.content["processes"]]


def _steps(*keys: str) -> Callable[[Planned], Any]:
    return lambda plan: [[step[key] for key in keys] for step in plan.steps]


def _components(plan: Planned) -> Any:
    return [component["plugin"] for component in plan.content["components"]]


# Row -> actions, what is looked at, what it is.
CASES: dict[str, tuple[str, Callable[[Planned], Any], Any]] = {
    "4.1 1, groups and includes": (
        "LogInfo(msg='a'), GroupAction([LogInfo(msg='b'), IncludeLaunchDescription('inner.launch.py')]), LogInfo(msg='d')",
        _messages, ["a", "b", "t is none", "d"],
    ),
    "4.1 2, configurations": (
        "SetLaunchConfiguration('x', '1'), ExecuteProcess(cmd=['a', LC('x')]), SetLaunchConfiguration('x', '2')",
        _of("command"), [[["a", "1"]]],
    ),
    "4.1 2, environment": (
        "SetEnvironmentVariable('X', '1'), ExecuteProcess(cmd=['a']), SetEnvironmentVariable('X', '2')",
        _of("environment"), [[{"X": "1"}]],
    ),
    "4.1 3": (
        "GroupAction([SetLaunchConfiguration('x', 'inside'), TimerAction(period=1.0, actions=[say('x')]), "
        "ExecuteProcess(cmd=['a'], on_exit=[say('x')]), "
        "RegisterEventHandler(OnProcessExit(on_exit=[say('x')]))]), SetLaunchConfiguration('x', 'later')",
        lambda plan: sorted(plan.messages), ["inside", "inside", "inside"],
    ),
    "4.1 4, newest first": (
        "on_custom(LogInfo(msg='old')), on_custom(LogInfo(msg='new')), EmitEvent(event=Custom()), LogInfo(msg='before')",
        _messages, ["before", "new", "old"],
    ),
    "4.1 4, locals": (
        "on_custom(LogInfo(msg=LocalSubstitution('event.name'))), EmitEvent(event=Custom())", _messages, ["custom"],
    ),
    "4.1 5": (
        "on_custom(LogInfo(msg='first'), on_custom(LogInfo(msg='second'))), EmitEvent(event=Custom())",
        _messages, ["first"],
    ),
    "4.1 8, substitutions": ("LogInfo(msg=[Counted(), Counted()]), say('x')", _messages, ["12", "none"]),
    "4.1 8, conditions": ("LogInfo(msg='a', condition=Once())", _messages, ["a"]),
    "4.2 scoped and forwarding": (
        "SetLaunchConfiguration('x', '1'), GroupAction([say('x'), say('k'), SetLaunchConfiguration('x', '2'), say('x')], "
        "launch_configurations={'k': LC('x')}), say('x'), say('k')",
        _messages, ["1", "1", "2", "1", "none"],
    ),
    "4.2 scoped without forwarding": (
        "SetLaunchConfiguration('x', '1'), SetEnvironmentVariable('OLD', 'new'), "
        "GroupAction([say('x'), say('k'), LogInfo(msg=EnvironmentVariable('OLD'))], forwarding=False, "
        "launch_configurations={'k': LC('x')}), LogInfo(msg=EnvironmentVariable('OLD'))",
        _messages, ["none", "1", "old", "new"],
    ),
    "4.2 not scoped": (
        "GroupAction([SetEnvironmentVariable('X', '1'), SetLaunchConfiguration('x', '2')], scoped=False, "
        "launch_configurations={'k': '3'}), say('x'), say('k'), LogInfo(msg=EnvironmentVariable('X'))",
        _messages, ["2", "3", "1"],
    ),
    "4.2 scoped data": (
        "SetParameter('p', 0), SetRemap('a', 'b'), GroupAction([PushROSNamespace('g'), SetParameter('p', 1), "
        "SetRemap('c', 'd'), node()]), node('m')",
        _of("id", "parameters", "remappings"),
        [["/g/n", {"p": 1}, [["a", "b"], ["c", "d"]]], ["/m", {"p": 0}, [["a", "b"]]]],
    ),
    "4.2 scoped data, without forwarding": (
        "PushROSNamespace('g'), SetParameter('p', 0), SetRemap('a', 'b'), GroupAction([node()], forwarding=False)",
        _of("id", "parameters", "remappings"), [["/n", {}, []]],
    ),
    "4.3 scope": ("IncludeLaunchDescription('inner.launch.py'), say('set')", _messages, ["t is none", "inside"]),
    "4.3 arguments": (
        "IncludeLaunchDescription('inner.launch.py', launch_arguments=[('t', '7')]), say('t')", _messages, ["t is 7", "7"],
    ),
    "4.3 default values": (
        "SetLaunchConfiguration('t', '1'), IncludeLaunchDescription('inner.launch.py')", _messages, ["t is 1"],
    ),
    "4.3 isolation": (
        "GroupAction([IncludeLaunchDescription('inner.launch.py', launch_arguments=[('t', '7')])]), say('t'), say('set')",
        _messages, ["t is 7", "none", "none"],
    ),
    "4.3 isolation, without forwarding": (
        "SetLaunchConfiguration('t', '1'), GroupAction([IncludeLaunchDescription('inner.launch.py')], forwarding=False)",
        _messages, ["t is none"],
    ),
    "4.3 required check": (
        "IncludeLaunchDescription('needs.launch.py')", lambda plan: ["'needed'" in problem for problem in plan.problems], [True],
    ),
    "4.3 required check, given": (
        "IncludeLaunchDescription('needs.launch.py', launch_arguments=[('needed', '1')])", _problems, [],
    ),
    "D4": ("SetLaunchConfiguration('needed', '1'), IncludeLaunchDescription('needs.launch.py')", _problems, []),
    "4.3 duplicate declarations": (
        "DeclareLaunchArgument('t', default_value='1'), DeclareLaunchArgument('t', default_value='2'), say('t')",
        _messages, ["1"],
    ),
    "1.3.1 default": ("DeclareLaunchArgument('t', default_value=['a', LC('x', default='b')]), say('t')", _messages, ["ab"]),
    "1.3.1 value that is set": (
        "SetLaunchConfiguration('t', '1'), DeclareLaunchArgument('t', default_value=Counted()), say('t')", _messages, ["1"],
    ),
    "1.12.1 namespace": (
        "PushROSNamespace('g'), node(namespace='a'), node(namespace='/a'), node(namespace=''), node(namespace=['a', LC('x', default='b')])",
        _ids, ["/g/a/n", "/a/n", "/g/n", "/g/ab/n"],
    ),
    "4.4 none at all": (
        "Node(executable='/bin/true')", _of("command"), [[["/bin/true", "--ros-args"]]],
    ),
    "4.5 rules for one node": (
        "node()", _of("command"), [[["/bin/true", "--ros-args", "-r", "__node:=n"]]],
    ),
    "D24": ("node()", _of("command"), [[["/bin/true", "--ros-args", "-r", "__node:=n"]]]),
    "4.7 condition": (
        "LoadComposableNodes(target_container='/c', composable_node_descriptions=["
        "ComposableNode(package='p', plugin='A', condition=IfCondition('false')), ComposableNode(package='p', plugin='B')])",
        _components, ["B"],
    ),
    "4.7 executables": (
        "ComposableNodeContainer(executable='/bin/component_container_mt', name='c', namespace='')",
        _of("kind", "id"), [["container", "/c"]],
    ),
    "4.10 launch configurations, namespace": (
        "PushROSNamespace('a'), PushROSNamespace('b'), say('ros_namespace'), SetLaunchConfiguration('ros_namespace', '/x'), node()",
        lambda plan: [plan.messages, _ids(plan)], [["/a/b"], ["/x/n"]],
    ),
    "4.10 launch configurations, taken away": (
        "PushROSNamespace('a'), UnsetLaunchConfiguration('ros_namespace'), node()", _ids, ["/n"],
    ),
    "4.10 launch configurations, parameters and remaps": (
        "SetParameter('p', 1), SetRemap('a', 'b'), read('global_params'), read('ros_remaps')",
        _messages, ["[('p', 1)]", "[('a', 'b')]"],
    ),
    "D72": (
        "SetParameter('p', 1), OpaqueFunction(function=lambda context: context.launch_configurations.update("
        "global_params=context.launch_configurations['global_params'] + [('q', 2)])), node()",
        _of("parameters"), [[{"p": 1, "q": 2}]],
    ),
    "4.10 launch configurations, processes": (
        "SetLaunchConfiguration('emulate_tty', 'true'), SetLaunchConfiguration('sigterm_timeout', '7'), "
        "SetLaunchConfiguration('sigkill_timeout', '8'), SetLaunchConfiguration('launch-prefix', 'nice -n 5'), "
        "ExecuteProcess(cmd=['a']), ExecuteProcess(cmd=['b'], emulate_tty=False, sigterm_timeout='1', prefix='')",
        _of("emulate_tty", "stop", "prefix"),
        [
            [True, {"signal": "SIGINT", "timeout": 7.0, "kill_timeout": 8.0}, ["nice", "-n", "5"]],
            [True, {"signal": "SIGINT", "timeout": 1.0, "kill_timeout": 8.0}, []],
        ],
    ),
    "4.12 signal one process": (
        "process, EmitEvent(event=SignalProcess(signal_number=signal.SIGUSR1, process_matcher=matches_name('a-1')))",
        _steps("action", "processes", "signal"), [["signal", ["a"], "SIGUSR1"]],
    ),
    "4.12 everything down": (
        "EmitEvent(event=events.Shutdown(reason='r')), Shutdown(reason='s'), EmitEvent(event=events.Shutdown)",
        _steps("action", "reason"), [["shutdown", "r"], ["shutdown", "s"], ["shutdown", "reason not given"]],
    ),
    "4.8 required": (
        "ExecuteProcess(cmd=['a'], on_exit=Shutdown()), ExecuteProcess(cmd=['b'], on_exit=[Shutdown(reason=['why ', LC('x', default='not')])])",
        lambda plan: [
            [process["required"] for process in plan.content["processes"]],
            [(trigger["on"]["event"], trigger["on"]["target"]) for trigger in plan.triggers],
            [step["reason"] for step in plan.steps],
        ],
        [[True, True], [("process_exited", "a"), ("process_exited", "b")], ["a has ended", "why not"]],
    ),
    "1.2 LaunchDescription.visit, of a deprecated one": (
        "LaunchDescription([LogInfo(msg='a')], deprecated_reason='use the other')",
        lambda plan: [plan.messages, [problem.partition("launch.py ")[2] for problem in plan.problems]],
        [["a"], ["is deprecated: use the other"]],
    ),
    "1.7 OnIncludeLaunchDescription": (
        "EmitEvent(event=events.IncludeLaunchDescription(described)), LogInfo(msg='after')", _messages, ["after", "inner"],
    ),
    "1.7 OnIncludeLaunchDescription, another one": (
        "RegisterEventHandler(OnIncludeLaunchDescription()), EmitEvent(event=events.IncludeLaunchDescription(described)), "
        "LogInfo(msg='after')",
        _messages, ["after", "inner", "inner"],
    ),
    "1.7 OnExecutionComplete, of an action that is done at its visit": (
        "RegisterEventHandler(OnExecutionComplete(target_action=logged, on_completion=[LogInfo(msg='done')])), logged, "
        "LogInfo(msg='after')",
        _messages, ["logged", "after", "done"],
    ),
    "1.7 OnExecutionComplete, of a timer": (
        "RegisterEventHandler(OnExecutionComplete(target_action=timer, on_completion=[LogInfo(msg='done')])), timer",
        lambda plan: [(trigger["delay"], trigger["do"][0]["message"]) for trigger in plan.triggers],
        [(1.5, "timed"), (1.5, "done")],
    ),
    "1.7 OnExecutionComplete, of an action that is not visited": (
        "RegisterEventHandler(OnExecutionComplete(target_action=logged, on_completion=[LogInfo(msg='done')]))",
        _messages, [],
    ),
    "D42": (
        "process, EmitEvent(event=ProcessStdin(text=b'x', action=process, name='a', cmd=['a'], cwd=None, env=None, pid=1))",
        _problems, ["nobody writes to the standard input of a process: only event handlers hear of this"],
    ),
    "D44": ("process, process", _ids, ["a", "a#2"]),
    "D71": (
        "node(parameters=[{'a': ParameterValue(5, value_type=float), 'b': ParameterValue([1, 2], value_type=List[float])}])",
        _of("parameters"), [[{"a": 5.0, "b": [1.0, 2.0]}]],
    ),
    "7 13": (
        "GroupAction([SetLaunchConfiguration('t', 'inner'), TimerAction(period=0.5, actions=[say('t')])]), "
        "SetLaunchConfiguration('t', 'outer')",
        _messages, ["inner"],
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", conforming(CASES))
def test_a_row_of_the_language_holds(case: str, tmp_path: Path) -> None:
    actions, view, expected = CASES[case]
    inner = "DeclareLaunchArgument('t', default_value='none'), SetLaunchConfiguration('set', 'inside'), LogInfo(msg=['t is ', LC('t')])"
    plans.write(tmp_path / "inner.launch.py", inner)
    plans.write(tmp_path / "needs.launch.py", "DeclareLaunchArgument('needed')")
    found = plans.python(tmp_path, actions, _BEFORE)
    assert view(found) == expected, found.problems


# Every action with what it needs, and what it would leave in a plan.
CONDITIONAL = {
    "1.3 AppendEnvironmentVariable": "AppendEnvironmentVariable('OLD', 'x'",
    "1.3 DeclareLaunchArgument": "DeclareLaunchArgument('x'",
    "1.3 EmitEvent": "EmitEvent(event=events.Shutdown()",
    "1.3 ExecuteLocal": "ExecuteLocal(process_description=Executable(cmd=['b'])",
    "1.3 ExecuteProcess": "ExecuteProcess(cmd=['b']",
    "1.3 GroupAction": "GroupAction([LogInfo(msg='b')]",
    "1.3 IncludeLaunchDescription": "IncludeLaunchDescription('gone.launch.py'",
    "1.3 LogInfo": "LogInfo(msg='b'",
    "1.3 OpaqueCoroutine": "OpaqueCoroutine(coroutine=wait",
    "1.3 OpaqueFunction": "OpaqueFunction(function=lambda context: 1 / 0",
    "1.3 PopEnvironment": "PopEnvironment(",
    "1.3 PopLaunchConfigurations": "PopLaunchConfigurations(",
    "1.3 RegisterEventHandler": "RegisterEventHandler(OnShutdown(on_shutdown=LogInfo(msg='b'))",
    "1.3 ResetEnvironment": "SetEnvironmentVariable('X', '1'), ResetEnvironment(",
    "1.3 ResetLaunchConfigurations": "ResetLaunchConfigurations(",
    "1.3 SetEnvironmentVariable": "SetEnvironmentVariable('OLD', 'x'",
    "1.3 SetLaunchConfiguration": "SetLaunchConfiguration('a', 'x'",
    "1.3 Shutdown": "Shutdown(",
    "1.3 TimerAction": "TimerAction(period=1.0, actions=[LogInfo(msg='b')]",
    "1.3 UnregisterEventHandler": "UnregisterEventHandler(OnShutdown(on_shutdown=[])",
    "1.3 UnsetEnvironmentVariable": "UnsetEnvironmentVariable('OLD'",
    "1.3 UnsetLaunchConfiguration": "UnsetLaunchConfiguration('a'",
    "1.12 Node": "Node(package='gone', executable='x'",
    "1.12 LifecycleNode": "LifecycleNode(package='gone', executable='x', name='n', namespace=''",
    "1.12 ComposableNodeContainer": "ComposableNodeContainer(package='gone', executable='x', name='n', namespace=''",
    "1.12 LoadComposableNodes": "LoadComposableNodes(target_container='/c', composable_node_descriptions=["
    "ComposableNode(package='p', plugin='A')]",
    "1.12 LifecycleTransition": "LifecycleTransition(lifecycle_node_names=['/n'], transition_ids=[1]",
    "1.12 PushROSNamespace": "PushROSNamespace('x'",
    "1.12 SetParameter": "SetParameter('x', 1",
    "1.12 SetParametersFromFile": "SetParametersFromFile('gone.yaml'",
    "1.12 SetRemap": "SetRemap('x', 'y'",
    "1.12 SetROSLogDir": "SetROSLogDir('x'",
    "1.12 SetUseSimTime": "SetUseSimTime(True",
    "1.12 ROSTimer": "ROSTimer(period=1.0, actions=[LogInfo(msg='b')]",
}
_WITHOUT = "SetLaunchConfiguration('a', '1'), SetEnvironmentVariable('X', '1'), {}node(), say('a')"


@pytest.mark.parametrize("case", conforming(CONDITIONAL))
@pytest.mark.parametrize("condition", ["IfCondition('false')", "UnlessCondition(LC('a'))"])
def test_an_action_whose_condition_does_not_hold_does_nothing(
    case: str, condition: str, tmp_path: Path
) -> None:
    before = f"{_BEFORE}\nasync def wait(context): pass\n"
    comma = "" if CONDITIONAL[case].endswith("(") else ", "
    written = f"{CONDITIONAL[case]}{comma}condition={condition}), "
    found = plans.python(tmp_path, _WITHOUT.format(written), before)
    assert found.problems == []
    assert {**found.content, "skipped": []} == plans.python(tmp_path, _WITHOUT.format(""), before).content
