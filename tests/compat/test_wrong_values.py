"""Whatever stands in place of an argument, a launch file is resolved or refused: at the user's place, in their words."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Final

import pytest

from orchestra.errors import Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.codec import encode

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

_HEAD = """\
from launch import *
from launch import events
from launch.actions import *
from launch.conditions import *
from launch.descriptions import Executable
from launch.event_handlers import *
from launch.events import matches_action
from launch.launch_description_sources import *
from launch.substitutions import *
from launch_ros.actions import *
from launch_ros.descriptions import *
from launch_ros.event_handlers import OnStateTransition
from launch_ros.substitutions import *

async def coroutine(*_):
    pass

def nothing(*_, **__):
    return None

PROCESS = ExecuteProcess(cmd=['true'])

def generate_launch_description():
    return LaunchDescription([PROCESS, {}])
"""

# Every marked argument of these is replaced by every value, one at a time.
_CALLS: Final = (
    "Node(package=«'demo'», executable=«'talker'», name=«'n'», namespace=«'a'», exec_name=«'l'», "
    "parameters=«[{'a': 1}]», remappings=«[('a', 'b')]», ros_arguments=«['-p']», arguments=«['x']», "
    "prefix=«'nice'», cwd=«'/'», env=«{'A': 'b'}», additional_env=«{'A': 'b'}», shell=«False», "
    "sigterm_timeout=«'1'», sigkill_timeout=«'1'», emulate_tty=«True», output=«'screen'», "
    "output_format=«'{line}'», cached_output=«False», log_cmd=«True», on_exit=«[LogInfo(msg='a')]», "
    "respawn=«True», respawn_delay=«1.0», respawn_max_retries=«2», condition=«IfCondition('1')», "
    "required=«True», depends_on=«[PROCESS]», ready=«{'delay': 1}», restart=«{'policy': 'no'}», "
    "stop=«{'timeout': 1}», success_exit_codes=«[1]»)",
    "ExecuteProcess(cmd=«['true']», name=«'p'», cwd=«'/'», env=«{'A': 'b'}», prefix=«'nice'»)",
    "ExecuteLocal(process_description=«Executable(cmd=['true'])»)",
    "LifecycleNode(package=«'demo'», executable=«'talker'», name=«'n'», namespace=«''», autostart=«True»)",
    "ComposableNodeContainer(package=«'demo'», executable=«'talker'», name=«'n'», namespace=«''», "
    "composable_node_descriptions=«[ComposableNode(package='demo', plugin='p')]»)",
    "LoadComposableNodes(target_container=«'/c'», composable_node_descriptions=«[]», "
    "condition=«IfCondition('1')»)",
    "DeclareLaunchArgument(«'a'», default_value=«'1'», description=«'d'», choices=«['1', '2']»)",
    "IncludeLaunchDescription(«'b.launch.py'», launch_arguments=«[('q', '2')]», scoped=«True», "
    "for_each=«{'v': ['1']}»)",
    "GroupAction(actions=«[LogInfo(msg='a')]», scoped=«True», forwarding=«False», "
    "launch_configurations=«{'a': '1'}»)",
    "TimerAction(period=«1.0», actions=«[LogInfo(msg='a')]», cancel_on_shutdown=«True»)",
    "RosTimer(period=«1.0», actions=«[LogInfo(msg='a')]»)",
    "RegisterEventHandler(event_handler=«OnShutdown(on_shutdown=[])»)",
    "UnregisterEventHandler(event_handler=«OnShutdown(on_shutdown=[])»)",
    "EmitEvent(event=«events.Shutdown()»)",
    "AppendEnvironmentVariable(name=«'a'», value=«'b'», prepend=«True», separator=«'-'»)",
    "SetEnvironmentVariable(«'a'», «'b'»)",
    "UnsetEnvironmentVariable(«'a'»)",
    "SetLaunchConfiguration(«'a'», «'b'»)",
    "UnsetLaunchConfiguration(«'a'»)",
    "ResetLaunchConfigurations(launch_configurations=«{'a': 'b'}»)",
    "OpaqueFunction(function=«nothing», args=«[1]», kwargs=«{'a': 1}»)",
    "OpaqueCoroutine(coroutine=«coroutine», args=«[1]», kwargs=«{'a': 1}», ignore_context=«True»)",
    "LogInfo(msg=«'a'», condition=«IfCondition('1')»)",
    "Shutdown(reason=«'a'»)",
    "PushRosNamespace(«'a'»)",
    "SetParameter(name=«'a'», value=«1»)",
    "SetParametersFromFile(«'p.yaml'»)",
    "SetRemap(src=«'a'», dst=«'b'»)",
    "SetROSLogDir(«'a'»)",
    "SetUseSimTime(«True»)",
    "LifecycleTransition(lifecycle_node_names=«['n']», transition_ids=«[1]»)",
)  # fmt: skip
# The same, inside of what takes them.
_INNER: Final = {
    "RegisterEventHandler({})": (
        "OnProcessExit(target_action=«PROCESS», on_exit=«[LogInfo(msg='a')]», handle_once=«True»)",
        "OnProcessIO(target_action=«PROCESS», on_stdout=«nothing», on_stderr=«nothing», "
        "on_stdin=«nothing»)",
        "OnExecutionComplete(target_action=«PROCESS», on_completion=«[LogInfo(msg='a')]»)",
        "OnShutdown(on_shutdown=«[LogInfo(msg='a')]»)",
        "EventHandler(matcher=«nothing», entities=«[LogInfo(msg='a')]»)",
        "OnStateTransition(entities=«[]», target_lifecycle_node=«None», transition=«'x'», "
        "start_state=«'y'», goal_state=«'z'»)",
    ),
    "LogInfo(msg={})": (
        "LaunchConfiguration(«'x'», default=«'1'»)",
        "EnvironmentVariable(«'x'», default_value=«'1'»)",
        "PathJoinSubstitution(«['a', 'b']»)",
        "PythonExpression(«['1']», «['math']»)",
        "Command(«'echo a'», on_stderr=«'fail'»)",
        "FindExecutable(name=«'sh'»)",
        "FileContent(«'p.yaml'»)",
        "AnonName(«'a'»)",
        "AndSubstitution(«'1'», «'0'»)",
        "EqualsSubstitution(«'1'», «'0'»)",
        "IfElseSubstitution(«'1'», «'a'», «'b'»)",
        "LocalSubstitution(«'current_launch_file_path'»)",
        "FindPackageShare(«'demo'»)",
        "ExecutableInPackage(executable=«'talker'», package=«'demo'»)",
    ),
    "Node(executable='/bin/true', parameters=[{}])": (
        "{'a': ParameterValue(«1», value_type=«int»)}",
        "ParameterFile(«'p.yaml'», allow_substs=«True»)",
    ),
    "LoadComposableNodes(target_container='/c', composable_node_descriptions=[{}])": (
        "ComposableNode(package=«'demo'», plugin=«'p'», name=«'n'», namespace=«''», "
        "parameters=«[{'a': 1}]», remappings=«[('a', 'b')]», extra_arguments=«[{'a': True}]», "
        "condition=«IfCondition('1')»)",
    ),
    "{}": (
        "OpaqueFunction(function=lambda context: «1»)",
        "OpaqueFunction(function=lambda context: context.launch_configurations.__setitem__('a', «1»))",
        "OpaqueFunction(function=lambda context: context.launch_configurations.__setitem__('global_params', «1»))",
        "OpaqueFunction(function=lambda context: context.environment.__setitem__('A', «1»))",
        "OpaqueFunction(function=lambda context: context.emit_event_sync(«1»))",
        "OpaqueFunction(function=lambda context: context.register_event_handler(«1»))",
    ),
}  # fmt: skip
_VALUES: Final = (
    *("None", "5", "-1.5", "True", "10**400", "float('nan')", "float('inf')", "b'x'"),
    *("''", "' '", "'$(var x)'", "'\\x00'", "'x' * 5000", "LaunchConfiguration('gone')", "IfCondition('1')"),
    *("[]", "[None]", "[[]]", "[[None]]", "[5]", "['a']", "range(3)", "iter(['a'])", "('a', 'b')", "[('a', 'b')]"),
    *("[('a',)]", "{}", "{'a': 1}", "{1: 2}", "[{'a': LaunchConfiguration('gone')}]", "{'stdout': 5}"),
    *("object()", "nothing", "lambda *_: None", "Shutdown", "events.Shutdown()", "OnShutdown(on_shutdown=[])"),
    *("LogInfo(msg='a')", "[LogInfo(msg='a')]", "LaunchDescription([LogInfo(msg='a')])"),
)  # fmt: skip


def _replaced(text: str, around: str = "{}") -> Iterator[str]:
    """Yield a call, in what is around it, with each of its marked arguments replaced by each value."""
    parts = re.split("[«»]", text)
    for index in range(1, len(parts), 2):
        for value in _VALUES:
            changed = "".join(value if place == index else part for place, part in enumerate(parts))
            yield around.replace("{}", changed)


_CASES: Final = (
    *(case for call in _CALLS for case in _replaced(call)),
    *(case for around, calls in _INNER.items() for call in calls for case in _replaced(call, around)),
)
_SOME: Final = 31  # of which the default suite takes one


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the prefix of a package; the working directory has a launch file to include and a parameter file."""
    prefix = tmp_path / "install"
    for folder in ("share/ament_index/resource_index/packages", "lib/demo", "share/demo"):
        (prefix / folder).mkdir(parents=True)
    (prefix / "share/ament_index/resource_index/packages/demo").touch()
    (prefix / "lib/demo/talker").write_text("#!/bin/sh\n", "utf-8")
    (prefix / "lib/demo/talker").chmod(0o755)
    (tmp_path / "p.yaml").write_text("/**: {ros__parameters: {a: 1}}", "utf-8")
    inner = "def generate_launch_description():\n    return LaunchDescription([DeclareLaunchArgument('q')])\n"
    imports = "from launch import *\nfrom launch.actions import *\n"
    (tmp_path / "b.launch.py").write_text(imports + inner, "utf-8")
    monkeypatch.chdir(tmp_path)
    return prefix


def test_some_values_are_resolved_or_refused(workspace: Path) -> None:
    _check(workspace, _CASES[::_SOME])


@pytest.mark.long
def test_all_values_are_resolved_or_refused(workspace: Path) -> None:
    _check(workspace, _CASES)


def _check(prefix: Path, cases: Sequence[str]) -> None:
    environment = {"PATH": "/usr/bin:/bin", "AMENT_PREFIX_PATH": str(prefix)}
    file = Path("a.launch.py")
    for case in cases:
        file.write_text(_HEAD.replace("{}", case), "utf-8")
        problems = Problems()
        plan = collect("a.launch.py", inputs_from([], environment=environment), problems)
        assert plan is not None or problems.errors, case
        if plan is not None:
            encode(plan)
        for problem in problems.errors:
            place = str(problem.span)
            assert place.startswith(("a.launch.py:", "b.launch.py:", "p.yaml:")), (case, place)
            assert "orchestra." not in problem.message.partition("<")[0], (case, problem.message)
