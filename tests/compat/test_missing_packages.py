"""Python launch files that look for packages which are not on this host."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import pytest

from orchestra.cli.look.looker import Looker
from orchestra.cli.targets import targets
from orchestra.errors import Code, Problem, Problems, Severity
from orchestra.pipeline import collect, inputs_from
from orchestra.resolve.refusals import missing_package
from tests.load.planning import installed

if TYPE_CHECKING:
    from pathlib import Path

_HEAD = """
from launch import *
from launch.actions import *
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import *
from launch_ros.substitutions import *
from ament_index_python import *
from ament_index_python.packages import *
"""
_NOTHING = "def generate_launch_description():\n    return LaunchDescription([])\n"


def _problems(folder: Path, text: str, *, launching: bool, inside: str | None = None) -> list[Problem]:
    path = folder / "a.launch.py"
    path.write_text(_HEAD + text, "utf-8")
    if inside is not None:
        path = folder / f"outer.launch.{inside}"
        outer = "launch: [include: {file: a.launch.py}]" if inside == "yaml" else _HEAD
        if inside == "py":
            outer += "def generate_launch_description():\n    return LaunchDescription(["
            outer += "IncludeLaunchDescription('a.launch.py')])\n"
        path.write_text(outer, "utf-8")
    problems = Problems()
    inputs = replace(inputs_from([], environment=installed(folder)), launching=launching)
    plan = collect(str(path), inputs, problems)
    # Code goes on with what was meant.
    slips = any(problem.suggestion or "did you mean 'demo'?" in problem.notes for problem in problems)
    assert (plan is None) == (inside is None and "def late" not in text and not slips)
    return list(problems)


def _marked(folder: Path, problem: Problem) -> str:
    assert problem.span is not None
    line = (folder / "a.launch.py").read_text("utf-8").splitlines()[problem.span.line - 1]
    return line[problem.span.column - 1 : problem.span.end_column - 1]


AT_IMPORT = f"SHARE = get_package_share_directory('gone')\n{_NOTHING}"
LATE = """
def late(context):
    return [LogInfo(msg=get_package_prefix('gone'))]
def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=late)])
"""


@pytest.mark.parametrize("launching", [True, False])
def test_a_file_that_needs_a_package_to_be_read_is_refused(tmp_path: Path, launching: bool) -> None:
    (problem,) = _problems(tmp_path, AT_IMPORT, launching=launching)
    assert (problem.code, problem.severity) == (Code.MISSING_PACKAGE, "error")
    assert "there is no package 'gone'" in problem.message
    assert _marked(tmp_path, problem) == "gone"


@pytest.mark.parametrize(
    ("text", "severity", "suggestion"),
    [
        (AT_IMPORT, "warning", None),
        (f"import nowhere_to_be_found\n{_NOTHING}", "warning", None),
        # Modules of packages, which are no slips for `secrets`, `launch_yaml` and `socket`.
        (f"import scripts\n{_NOTHING}", "warning", None),
        (f"import launch_pal\n{_NOTHING}", "warning", None),
        (f"import sockets\n{_NOTHING}", "warning", None),
        (f"import collectoins\n{_NOTHING}", "error", "collections"),
        (f"import launch.actoins\n{_NOTHING}", "error", "launch.actions"),
    ],
)
def test_a_check_only_tells_of_what_another_machine_may_have(
    tmp_path: Path, text: str, severity: str, suggestion: str | None
) -> None:
    (tmp_path / "a.launch.py").write_text(_HEAD + text, "utf-8")
    (target,) = targets([str(tmp_path / "a.launch.py")])
    finding, _ = Looker(inputs_from([], environment=installed(tmp_path))).look(target)
    assert [(each.severity, each.suggestion) for each in finding.problems] == [(severity, suggestion)]


@pytest.mark.parametrize("inside", ["yaml", "py"])
@pytest.mark.parametrize(("launching", "severity"), [(True, "error"), (False, "warning")])
def test_an_included_one_may_do_elsewhere(
    tmp_path: Path, inside: str, launching: bool, severity: str
) -> None:
    (problem,) = _problems(tmp_path, AT_IMPORT, launching=launching, inside=inside)
    assert (problem.code, problem.severity) == (Code.MISSING_PACKAGE, severity)
    assert len(problem.included_from) == 1


@pytest.mark.parametrize(("launching", "severity"), [(True, "error"), (False, "warning")])
def test_so_may_a_function(tmp_path: Path, launching: bool, severity: str) -> None:
    (problem,) = _problems(tmp_path, LATE, launching=launching)
    assert (problem.code, problem.severity) == (Code.MISSING_PACKAGE, severity)
    assert _marked(tmp_path, problem) == "gone"


@pytest.mark.parametrize("call", ["get_package_share_path('{}')", "get_package_prefix(package_name='{}')"])
def test_a_slip_is_an_error_with_the_name_that_was_meant(tmp_path: Path, call: str) -> None:
    text = f"SHARE = {call.format('demoo')}\n{_NOTHING}"
    (problem,) = _problems(tmp_path, text, launching=False)
    assert (problem.severity, problem.message) == ("error", "there is no package 'demoo' here")
    assert (problem.suggestion, _marked(tmp_path, problem)) == ("demo", "demoo")


def test_what_was_meant_is_a_note_where_the_name_comes_from_elsewhere(tmp_path: Path) -> None:
    text = f"NAME = 'demo'.replace('m', 'mm')\nSHARE = get_package_share_directory(NAME)\n{_NOTHING}"
    (problem,) = _problems(tmp_path, text, launching=False)
    assert problem.suggestion is None
    assert problem.notes == ("did you mean 'demo'?",)
    assert _marked(tmp_path, problem) == "get_package_share_directory(NAME)"


def test_code_of_others_may_raise_it_too(tmp_path: Path) -> None:
    (problem,) = _problems(tmp_path, f"raise PackageNotFoundError('no arm')\n{_NOTHING}", launching=True)
    assert (problem.code, problem.message) == (Code.MISSING_PACKAGE, "PackageNotFoundError: no arm")


PERFORMED = "def generate_launch_description():\n    {}\n    return LaunchDescription([])\n"


@pytest.mark.parametrize("launching", [True, False])
@pytest.mark.parametrize(
    "done",
    [
        "FindPackageShare('gone').perform(LaunchContext())",
        "FindPackagePrefix('gone').find('gone')",
        "PathJoinSubstitution([FindPackageShare('gone'), 'x']).perform(LaunchContext())",
    ],
)
def test_a_substitution_that_code_performs_is_the_same(tmp_path: Path, done: str, launching: bool) -> None:
    (problem,) = _problems(tmp_path, PERFORMED.format(done), launching=launching)
    assert (problem.code, problem.severity) == (Code.MISSING_PACKAGE, "error")


def test_an_action_that_code_visits_is_left_out_where_it_may_be_elsewhere(tmp_path: Path) -> None:
    text = f"LogInfo(msg=FindPackageShare('gone')).visit(LaunchContext())\n{_NOTHING} # def late"
    (problem,) = _problems(tmp_path, text, launching=False)
    assert (problem.code, problem.severity) == (Code.MISSING_PACKAGE, "warning")


def test_who_catches_it_goes_on(tmp_path: Path) -> None:
    text = """
try:
    get_package_share_directory('gone')
except (LookupError, PackageNotFoundError) as error:
    assert 'gone' in str(error)
def late(context): ...
def generate_launch_description():
    return LaunchDescription([])
"""
    assert _problems(tmp_path, text, launching=True) == []


@pytest.mark.parametrize(
    ("package", "severity", "meant"),
    [
        ("robot_state_publihser", "error", "robot_state_publisher"),
        ("sensor_msg", "error", "sensor_msgs"),
        ("tf2_rs", "error", "tf2_ros"),
        ("joint_state_publisher", "warning", None),
        ("turtlebot3_gazebo", "warning", None),
        ("ros_gz_image", "warning", None),
        ("utils", "warning", None),
        ("rcl_utils", "warning", None),
        ("cpputils", "warning", None),
    ],
)
def test_a_package_whose_name_has_another_word_is_no_slip(
    package: str, severity: str, meant: str | None
) -> None:
    """A machine may have one package of a family and not the others."""
    known = ("rcutils", "robot_state_publisher", "ros_gz_sim", "sensor_msgs", "tf2_ros", "turtlebot3_node")
    missing = missing_package(package, known, Severity.WARNING)
    assert (missing.severity, missing.meant) == (severity, meant)
