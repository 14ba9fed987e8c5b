"""Files that test a launch: what they import can be imported, and what they describe has a plan."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import pytest

from orchestra.compat import launch_pytest, launch_testing, launch_testing_ros
from orchestra.compat.launch_testing.markers import retry_on_failure
from orchestra.compat.launch_testing.running import ReadyAggregator
from orchestra.errors import Problem, Problems
from orchestra.pipeline import collect, inputs_from

if TYPE_CHECKING:
    from pathlib import Path
    from types import ModuleType

    from orchestra.plan.model import Plan

_ENVIRONMENT = {"PATH": "/usr/bin:/bin"}
_HEAD = """
import unittest

import launch
import launch_pytest
import launch_testing
import launch_testing.actions
import launch_testing.asserts
import launch_testing.markers
import launch_testing.tools
import launch_testing_ros
from launch_pytest.tools import process as process_tools
from launch_testing.asserts import EXIT_OK, assertExitCodes
from launch_testing.util import KeepAliveProc
from launch_testing_ros import WaitForTopics
"""
_TESTS = """
@launch_testing.post_shutdown_test()
class TestExit(unittest.TestCase):
    @launch_testing.markers.retry_on_failure(times=3)
    def test_exit(self, proc_info):
        assertExitCodes(proc_info, [EXIT_OK])
"""


def _planned(path: Path, text: str) -> tuple[Plan | None, tuple[Problem, ...]]:
    path.write_text(_HEAD + text + _TESTS)
    problems = Problems()
    plan = collect(str(path), inputs_from([], environment=_ENVIRONMENT), problems)
    return plan, problems.ordered


@pytest.mark.conforms(
    "1.18 test files",
    "1.18 actions.ReadyToTest",
    "1.18 actions.Test",
    "1.18 actions.GTest",
    "1.18 post_shutdown_test",
    "1.18 ready_to_test_action_timeout",
    "1.18 markers.keep_alive",
    "D60",
)
def test_a_test_of_a_launch_has_a_plan(tmp_path: Path) -> None:
    path = tmp_path / "test_a.py"
    plan, problems = _planned(
        path,
        """
@launch_testing.ready_to_test_action_timeout(10)
@launch_testing.markers.keep_alive
def generate_test_description():
    unit = launch_testing.actions.GTest(path="/bin/true", timeout=3, kill_timeout=2.0, name="unit")
    suite = launch_testing.actions.PyTest(path=["tests", "/all"])
    ready = launch.actions.TimerAction(period=1.0, actions=[launch_testing.actions.ReadyToTest()])
    return launch.LaunchDescription([unit, suite, ready]), {"unit": unit}
""",
    )
    assert not problems
    assert plan is not None
    unit, suite, idle = plan.processes
    assert unit.command == ("/bin/true",)
    assert unit.stop is not None
    assert unit.stop.timeout == 2.0
    assert suite.command[1:] == ("-m", "pytest", "tests/all")
    assert suite.command[0].endswith("/python3")
    assert (idle.command[0], idle.location.span.line) == (sys.executable, 17)
    after = [(trigger.delay, [type(step).__name__ for step in trigger.do]) for trigger in plan.triggers]
    assert after == [(3.0, ["StopAction"])]
    assert {trigger.location.span.file for trigger in plan.triggers} == {str(path)}


@pytest.mark.conforms("1.18 parametrize", "D60")
@pytest.mark.parametrize(
    ("above", "below"),
    [("", ""), ("@launch_testing.markers.keep_alive", ""), ("", "@launch_testing.markers.keep_alive")],
)
def test_of_several_values_the_first_counts(tmp_path: Path, above: str, below: str) -> None:
    plan, problems = _planned(
        tmp_path / "test_a.py",
        f"""
{above}
@launch_testing.parametrize("word, other", [("first", 1), ("second", 2)])
{below}
def generate_test_description(word, other):
    return launch.LaunchDescription([launch.actions.ExecuteProcess(cmd=["prog", word, str(other)])])
""",
    )
    assert not problems
    assert plan is not None
    assert plan.processes[0].command == ("prog", "first", "1")
    assert len(plan.processes) == (2 if above or below else 1)


@pytest.mark.conforms("1.18 util.KeepAliveProc", "D60")
def test_functions_of_the_days_before_ready_to_test_are_called_too(tmp_path: Path) -> None:
    plan, problems = _planned(
        tmp_path / "test_a.py",
        """
def generate_test_description(ready_fn):
    ready = launch.actions.OpaqueFunction(function=lambda context: ready_fn())
    return launch.LaunchDescription([KeepAliveProc(), ready])
""",
    )
    assert not problems
    assert plan is not None
    assert len(plan.processes) == 1


def test_a_file_with_both_functions_is_a_launch_file(tmp_path: Path) -> None:
    plan, problems = _planned(
        tmp_path / "test_a.py",
        """
def generate_test_description():
    raise AssertionError

def generate_launch_description():
    return launch.LaunchDescription([launch.actions.ExecuteProcess(cmd=["prog"])])
""",
    )
    assert not problems
    assert plan is not None
    assert [process.command for process in plan.processes] == [("prog",)]


def test_what_tests_of_old_add_ends_the_run(tmp_path: Path) -> None:
    plan, problems = _planned(
        tmp_path / "test_a.py",
        """
from launch_testing.legacy import LaunchTestService

def generate_launch_description():
    description = launch.LaunchDescription()
    service = LaunchTestService()
    service.add_fixture_action(description, launch.actions.ExecuteProcess(cmd=["fixture"]))
    service.add_test_action(description, launch.actions.ExecuteProcess(cmd=["test"]))
    return description
""",
    )
    assert not problems
    assert plan is not None
    assert [process.command for process in plan.processes] == [("fixture",), ("test",)]
    assert [[type(step).__name__ for step in trigger.do] for trigger in plan.triggers] == [["ShutdownAction"]]


@pytest.mark.parametrize("package", [launch_testing, launch_testing_ros, launch_pytest])
def test_every_name_can_be_imported(package: ModuleType) -> None:
    assert all(getattr(package, name) is not None for name in package.__all__)


@pytest.mark.conforms("D60")
@pytest.mark.parametrize(
    "used",
    [
        lambda: launch_testing.asserts.assertExitCodes({}),
        lambda: launch_testing.tools.launch_process(None, None, None, None),
        lambda: launch_testing.util.resolveProcesses(None),
        lambda: launch_testing_ros.WaitForTopics([]),
        lambda: launch_pytest.tools.wait_for_output_sync(None, None, None),
    ],
)
def test_what_needs_a_run_says_so(used: object) -> None:
    assert callable(used)
    with pytest.raises(RuntimeError, match="belongs to tests that run"):
        used()


@pytest.mark.conforms("1.18 markers.retry_on_failure")
def test_a_test_is_tried_again_when_it_fails() -> None:
    calls: list[int] = []

    @retry_on_failure(times=3)
    def passes_the_third_time() -> str:
        calls.append(1)
        assert len(calls) > 2
        return "passed"

    assert passes_the_third_time() == "passed"
    with pytest.raises(AssertionError):
        retry_on_failure(times=2)(_fail)()
    with pytest.raises(ValueError, match="at least once"):
        retry_on_failure(times=0)


def _fail() -> None:
    raise AssertionError


def test_calls_are_aggregated() -> None:
    called: list[str] = []
    aggregator = ReadyAggregator(lambda: called.append("ready"), 2)
    aggregator.ready_fn()
    assert not called
    aggregator.ready_fn()
    assert called == ["ready"]


@pytest.mark.conforms(
    "1.18 event_handlers.StdoutReadyListener", "1.19 fixture", "1.19 actions.ReadyToTest", "D60"
)
def test_descriptions_of_pytest_files_can_be_made(tmp_path: Path) -> None:
    plan, problems = _planned(
        tmp_path / "test_a.py",
        """
from launch_testing.event_handlers import StdoutReadyListener

@launch_pytest.fixture
def plain():
    return launch.LaunchDescription([launch_pytest.actions.ReadyToTest()])

@launch_pytest.fixture(scope="module", auto_shutdown=False)
def generate_launch_description():
    process = launch.actions.ExecuteProcess(cmd=["prog"])
    ready = StdoutReadyListener(target_action=process, ready_txt="up", actions=[launch.actions.LogInfo(msg="ready")])
    return launch.LaunchDescription([plain(), launch.actions.RegisterEventHandler(ready), process])
""",
    )
    assert not problems
    assert plan is not None
    assert [process.command for process in plan.processes] == [("prog",)]
    assert [(trigger.on.event, trigger.on.stream, trigger.deferred) for trigger in plan.triggers] == [
        ("process_output", "stdout", True)
    ]
