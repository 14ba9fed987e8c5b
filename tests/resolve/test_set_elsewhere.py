"""What is read where it is not set: where the description declares or sets it is told with that."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code
from tests.resolve.python.test_visiting import planned

if TYPE_CHECKING:
    from pathlib import Path

_UNSET = "no launch argument or variable 'x' is set here"
_READ = '<log message="$(var x)"/>'
_ENTITIES = "def generate_launch_description():\n    return LaunchDescription([{}])\n"
_LATE = "LogInfo(msg=LaunchConfiguration('x')), DeclareLaunchArgument('x', default_value='1')"
_ENDED = "GroupAction([DeclareLaunchArgument('x', default_value='1')]), LogInfo(msg=LaunchConfiguration('x'))"
_ONLY = f"{_UNSET}, only elsewhere"

# The files, what is told, and how each note begins and ends.
CASES = {
    "an argument below": (
        {"main.launch.xml": f'<launch>\n{_READ}\n<arg name="x" default="1"/>\n</launch>'},
        f"{_UNSET} yet",
        ("it is declared below, at ", "main.launch.xml:3:2"),
    ),
    "an argument below, in YAML": (
        {"main.launch.yaml": "launch:\n- log: {message: $(var x)}\n- arg: {name: x, default: '1'}\n"},
        f"{_UNSET} yet",
        ("it is declared below, at ", "main.launch.yaml:3:3"),
    ),
    "a variable below": (
        {"main.launch.xml": f'<launch>\n{_READ}\n<let name="x" value="1"/>\n</launch>'},
        f"{_UNSET} yet",
        ("it is set below, at ", "main.launch.xml:3:12"),
    ),
    "an argument of a group that has ended": (
        {"main.launch.xml": f'<launch>\n<group><arg name="x" default="1"/></group>\n{_READ}\n</launch>'},
        _ONLY,
        ("it is declared at ", "main.launch.xml:2:9, for what comes behind that in the same group"),
    ),
    "an argument behind the file that reads it": (
        {
            "main.launch.xml": '<launch>\n<include file="$(dirname)/part.launch.xml"/>\n'
            '<arg name="x" default="1"/>\n</launch>',
            "part.launch.xml": f"<launch>\n{_READ}\n</launch>",
        },
        _ONLY,
        ("it is declared at ", "main.launch.xml:3:2, for what comes behind that in the same group"),
    ),
    "an argument that is added too late": (
        {"main.launch.py": _ENTITIES.format(_LATE)},
        _ONLY,
        ("it is declared at ", ", for what comes behind that in the same group"),
    ),
    "an argument that a group in Python declares": (
        {"main.launch.py": _ENTITIES.format(_ENDED)},
        _ONLY,
        ("it is declared at ", ", for what comes behind that in the same group"),
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_where_a_value_is_set_that_is_not_set_where_it_is_read_is_told(tmp_path: Path, name: str) -> None:
    files, message, (begin, end) = CASES[name]
    _, problems = planned(tmp_path, files)
    (problem,) = problems.errors
    assert (problem.code, problem.message) == (Code.UNDEFINED_VARIABLE, message)
    (note,) = problem.notes
    assert note.startswith(begin)
    assert note.endswith(end)


def test_a_slip_for_a_name_below_stays_one(tmp_path: Path) -> None:
    text = '<launch>\n<let name="speed" value="1"/>\n<log message="$(var sped)"/>\n<arg name="sped" default="1"/>\n</launch>'
    _, problems = planned(tmp_path, {"main.launch.xml": text})
    (problem,) = problems.errors
    assert problem.suggestion == "speed"
    assert problem.notes == ()


def test_a_value_that_the_caller_gives_counts_before_its_declaration(tmp_path: Path) -> None:
    text = f'<launch>\n{_READ}\n<arg name="x" default="1"/>\n</launch>'
    _, problems = planned(tmp_path, {"main.launch.xml": text}, "x:=2")
    assert not problems.errors


def test_a_value_that_nothing_sets_is_told_as_before(tmp_path: Path) -> None:
    _, problems = planned(tmp_path, {"main.launch.xml": f"<launch>\n{_READ}\n</launch>"})
    (problem,) = problems.errors
    assert (problem.message, problem.notes) == (_UNSET, ())
