"""Actions, substitutions and conditions in a context that user code builds, and by hand in that of the visit."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.resolve.python.test_visiting import messages, planned

if TYPE_CHECKING:
    from pathlib import Path

_HEAD = """
from launch import LaunchContext
from launch.event_handlers import OnShutdown
from launch.substitutions import SubstitutionFailure
from launch.utilities import visit_all_entities_and_collect_futures
from launch_ros.actions import *
from launch_ros.descriptions import *
from launch_ros.substitutions import *
from ament_index_python.packages import PackageNotFoundError
class Mine(Action):
    def execute(self, context):
        context.launch_configurations['x'] = 'mine'
        return [LogInfo(msg='said')]
"""
_INNER = """
def generate_launch_description():
    return LaunchDescription([DeclareLaunchArgument('q'), SetLaunchConfiguration('x', LaunchConfiguration('q')), Node()])
"""

# An action, and what is set in its context afterwards.
WORKS = [
    ("Node(executable='/bin/true', name='n', parameters=[{'a': 1}])", {}),
    ("LifecycleNode(executable='/bin/true', name='n', namespace='')", {}),
    ("ExecuteProcess(cmd=['/bin/true'], on_exit=[LogInfo(msg='x')])", {}),
    (
        "ComposableNodeContainer(executable='/bin/true', name='n', namespace='', "
        "composable_node_descriptions=[ComposableNode(package='p', plugin='P')])",
        {},
    ),
    (
        "LoadComposableNodes(target_container='/c', composable_node_descriptions="
        "[ComposableNode(package='p', plugin='P')])",
        {},
    ),
    ("DeclareLaunchArgument('x', default_value='1')", {"x": "1"}),
    ("SetLaunchConfiguration('x', '1')", {"x": "1"}),
    ("UnsetLaunchConfiguration('x')", {}),
    ("PushLaunchConfigurations()", {}),
    ("PushRosNamespace('x')", {"ros_namespace": "/x"}),
    ("SetParameter('x', 1)", {"global_params": [("x", 1)]}),
    ("SetRemap('x', 'y')", {"ros_remaps": [("x", "y")]}),
    (
        "IncludeLaunchDescription('inner.launch.yaml', launch_arguments={'q': '2'}.items())",
        {"q": "2", "x": "2"},
    ),
    (
        "IncludeLaunchDescription(PythonLaunchDescriptionSource('inner.launch.py'), launch_arguments=[('q', '2')])",
        {"q": "2", "x": "2"},
    ),
    ("TimerAction(period=1.0, actions=[LogInfo(msg='x')])", {}),
    ("LogInfo(msg='x')", {}),
    ("OpaqueFunction(function=lambda context: context.launch_configurations.update(x='1'))", {"x": "1"}),
    ("RegisterEventHandler(OnShutdown(on_shutdown=LogInfo(msg='x')))", {}),
    ("EmitEvent(event=ShutdownEvent())", {}),
    ("Shutdown(reason='x')", {}),
    ("Mine()", {"x": "mine"}),
    ("GroupAction([SetLaunchConfiguration('x', '1')])", {}),
    (
        "GroupAction([SetLaunchConfiguration('x', LaunchConfiguration('i'))], scoped=False, for_each={'i': ['7']})",
        {},
    ),
    ("SetLaunchConfiguration('x', '1', condition=IfCondition('false'))", {}),
]


def _said(folder: Path, lines: str) -> list[str]:
    """Return what a launch file says whose function runs these lines, which add to `told`."""
    body = "\n".join(f"    {line}" for line in lines.strip().splitlines())
    text = f"{_HEAD}\ndef generate_launch_description():\n    told = []\n{body}\n"
    text += "    return LaunchDescription([LogInfo(msg=str(item)) for item in told])\n"
    inner_yaml = "launch: [arg: {name: q}, let: {name: x, value: $(var q)}, node: {exec: /bin/true, name: n, namespace: m}]"
    inner = _INNER.replace("Node()", "ExecuteProcess(cmd=['/bin/true'])")
    files = {"main.launch.py": text, "inner.launch.yaml": inner_yaml, "inner.launch.py": inner}
    plan, problems = planned(folder, files, AMENT_PREFIX_PATH=str(folder))
    assert not problems.errors, list(problems)
    assert plan is not None
    assert plan.processes == ()
    return messages(plan)


@pytest.mark.parametrize(("action", "left"), WORKS)
def test_an_action_is_visited_in_a_context_of_its_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, action: str, left: dict[str, object]
) -> None:
    monkeypatch.chdir(tmp_path)
    lines = f"""
for how in ('visit', 'execute'):
    if how == 'visit' or not 'condition' in {action!r}:
        context = LaunchContext()
        action = {action}
        following = getattr(action, how)(context)
        for entity in following or ():
            visit_all_entities_and_collect_futures(entity, context)
        told.append(dict(context.launch_configurations))
"""
    told = _said(tmp_path, lines)
    assert told == [str(left)] * (1 if "condition" in action else 2)


def test_contexts_know_nothing_of_each_other_nor_of_the_launch(tmp_path: Path) -> None:
    lines = """
one, other = LaunchContext(), LaunchContext()
one.launch_configurations['x'] = '1'
one.environment['X_Y'] = '2'
told.append('x' in other.launch_configurations)
told.append('X_Y' in other.environment)
told.append(LaunchConfiguration('x').perform(one))
SetEnvironmentVariable('X_Z', '3').visit(one)
told.append((EnvironmentVariable('X_Z').perform(one), 'X_Z' in other.environment))
"""
    assert _said(tmp_path, lines) == ["False", "False", "1", "('3', False)"]


# What is done, and the name of what upstream raises.
RAISES = [
    ("LogInfo(msg=LaunchConfiguration('gone')).visit(context)", "SubstitutionFailure"),
    ("ExecuteProcess(cmd=[EnvironmentVariable('GONE')]).visit(context)", "SubstitutionFailure"),
    (
        "Node(executable='/bin/true', name=LaunchConfiguration('gone')).execute(context)",
        "SubstitutionFailure",
    ),
    ("LaunchConfiguration('gone').perform(context)", "SubstitutionFailure"),
    ("EnvironmentVariable('GONE').perform(context)", "SubstitutionFailure"),
    ("FindExecutable(name='gone').perform(context)", "SubstitutionFailure"),
    ("Command('false').perform(context)", "SubstitutionFailure"),
    ("ThisLaunchFileDir().perform(context)", "SubstitutionFailure"),
    ("PythonExpression('1 +').perform(context)", "SyntaxError"),
    ("LocalSubstitution('gone').perform(context)", "AttributeError"),
    ("FindPackageShare('gone').perform(context)", "PackageNotFoundError"),
    ("PathJoinSubstitution([FindPackageShare('gone'), 'x']).perform(context)", "PackageNotFoundError"),
    ("ExecutableInPackage('x', 'gone').perform(context)", "PackageNotFoundError"),
    (
        "LogInfo(msg=FindPackageShare('gone')).visit(context) or FindPackageShare('gonne').find('gonne')",
        "PackageNotFoundError",
    ),
    ("IfCondition('both').evaluate(context)", "InvalidConditionExpressionError"),
    ("LogInfo(msg='x', condition=IfCondition('both')).visit(context)", "InvalidConditionExpressionError"),
    ("DeclareLaunchArgument('x').visit(context)", "RuntimeError"),
    ("UnregisterEventHandler(OnShutdown(on_shutdown=[])).visit(context)", "ValueError"),
    ("IncludeLaunchDescription('gone.launch.py').visit(context)", "FileNotFoundError"),
    ("OpaqueFunction(function=lambda context: 1 / 0).visit(context)", "ZeroDivisionError"),
]


@pytest.mark.parametrize(("done", "raised"), RAISES)
@pytest.mark.parametrize("context", ["LaunchContext()", "of the visit"])
def test_user_code_sees_what_upstream_raises_and_may_go_on(
    tmp_path: Path, done: str, raised: str, context: str
) -> None:
    if context == "of the visit" and "ThisLaunchFileDir" in done:
        return  # there is a file
    lines = f"""
def attempt(context):
    try:
        {done}
    except Exception as error:
        told.append(type(error).__name__)
    return [LogInfo(msg=item) for item in told]
"""
    if context == "LaunchContext()":
        lines += "attempt(LaunchContext())"
        assert _said(tmp_path, lines) == [raised]
    else:
        lines += "return LaunchDescription([OpaqueFunction(function=attempt)])"
        assert _said(tmp_path, lines) == [raised]


def test_what_is_raised_in_user_code_is_told_at_its_line_where_nobody_catches_it(tmp_path: Path) -> None:
    text = (
        f"{_HEAD}\ndef generate_launch_description():\n    LogInfo(msg=LaunchConfiguration('gone')).visit(\n"
    )
    text += "        LaunchContext())\n    return LaunchDescription([])\n"
    _, problems = planned(tmp_path, {"main.launch.py": text})
    (problem,) = problems
    told = "no launch argument or variable 'gone' is set here; DeclareLaunchArgument('gone') declares it"
    assert problem.message == told
    assert problem.span is not None
    assert (
        "LaunchConfiguration('gone')"
        in (tmp_path / "main.launch.py").read_text().splitlines()[problem.span.line - 1]
    )


def test_a_process_that_user_code_could_not_start_is_not_in_the_plan(tmp_path: Path) -> None:
    text = (
        _HEAD
        + """
def attempt(context):
    try:
        GroupAction([Node(executable='/bin/true', name='a')]).visit(context)
        ExecuteProcess(cmd=['/bin/false', LaunchConfiguration('gone')]).visit(context)
    except SubstitutionFailure:
        ExecuteProcess(cmd=['/bin/echo']).visit(context)
def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=attempt)])
"""
    )
    plan, problems = planned(tmp_path, {"main.launch.py": text})
    assert plan is not None
    assert not problems.errors
    assert [process.command for process in plan.processes] == [("/bin/echo",)]
