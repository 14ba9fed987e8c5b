"""Python launch files that want environment variables which are not set on this host."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import pytest

from orchestra.cli.look.looker import Looker
from orchestra.cli.targets import targets
from orchestra.errors import Problem, Problems, Severity
from orchestra.pipeline import collect, inputs_from

if TYPE_CHECKING:
    from pathlib import Path

_HEAD: Final = """\
import os
import sys
from os import environ, getenv
from launch import LaunchDescription
from launch.actions import *
from launch.substitutions import *
from launch_ros.actions import Node

def generate_launch_description():
"""
# Each comes of the variable `QQ`, whose name is what is told.
_LEADS_TO = {
    "a key": "return LaunchDescription([LogInfo(msg=os.environ['QQ'])])",
    "a key and what is made of it": "model = environ['QQ']\nname = open(model + '.urdf').read()",
    "a sum": "model = getenv('QQ')\nreturn LaunchDescription([LogInfo(msg=model + '.yaml')])",
    "a sum in place": "path = '/tmp/'\npath += os.getenv('QQ')",
    "a variable of its own": "os.environ['PP'] = os.getenv('QQ')",
    "a joined path": "path = os.path.join('/tmp', os.environ.get('QQ'), 'a.yaml')",
    "a method": "model = os.getenv('QQ').lower()",
    "a number": "return LaunchDescription([TimerAction(period=float(os.getenv('QQ')), actions=[])])",
    "a file with None in its name": "text = open('/tmp/{}.yaml'.format(getenv('QQ'))).read()",
    "an include": "return LaunchDescription([IncludeLaunchDescription(f\"/tmp/{getenv('QQ')}.launch.py\")])",
    "a message": "return LaunchDescription([LogInfo(msg=os.getenv('QQ'))])",
    "a part of a path": "return LaunchDescription([LogInfo(msg=PathJoinSubstitution(['/tmp', os.getenv('QQ')]))])",
    "a word": "model = os.getenv('QQ')\nreturn LaunchDescription([ExecuteProcess(cmd=['true', model])])",
    "a default": "return LaunchDescription([DeclareLaunchArgument('m', default_value=os.getenv('QQ'))])",
    "an end": "if not os.getenv('QQ'):\n    sys.exit('set QQ')",
    "a refusal": "model = os.getenv('QQ')\nif model is None:\n    raise RuntimeError('set it')",
    "a refusal where it is looked for": "if 'QQ' not in os.environ:\n    raise RuntimeError('set it')",
    "a refusal of another kind": "try:\n    model = os.environ['QQ']\nexcept KeyError as error:\n    raise ValueError('no') from error",
    "an action": "return LaunchDescription([LogInfo(msg=EnvironmentVariable('QQ'))])",
    "a function": (
        "def ask(context):\n    return [LogInfo(msg=EnvironmentVariable('QQ').perform(context))]\n"
        "return LaunchDescription([OpaqueFunction(function=ask)])"
    ),
}
# Nothing of this comes of it for sure.
_OTHERWISE = {
    "another None": "model, other = os.getenv('QQ'), None\nname = other + '.yaml'",
    "a default that is used": "name = os.getenv('QQ', 'a') + None",
    "a mistake beside it": "model = os.getenv('QQ')\nreturn LaunchDescription([LogInfo(mgs='a')])",
    "another file": "model = os.getenv('QQ')\nname = open('none/a.yaml').read()",
    "a refusal of something else": "model = os.getenv('QQ')\nif 1 + 1 == 2:\n    raise RuntimeError('no')",
    "a slip": "os.environ['ROBOT_NAME'] = 'a'\nname = os.environ['ROBOT_NAEM']",
}


@pytest.mark.parametrize("what", _LEADS_TO)
def test_what_follows_from_an_unset_variable_is_a_note_that_names_it(what: str, tmp_path: Path) -> None:
    path = _written(tmp_path, _LEADS_TO[what])
    (problem,) = _checked(path)
    assert (problem.severity, problem.code) == (Severity.NOTE, "ORC021"), problem
    assert "'QQ' is not set" in problem.message
    span = problem.span
    assert span is not None
    line = path.read_text().splitlines()[span.line - 1]
    assert line[span.column - 1 : span.end_column - 1] == "QQ"


@pytest.mark.parametrize("what", _LEADS_TO)
def test_a_plan_needs_its_value(what: str, tmp_path: Path) -> None:
    problems = Problems()
    collect(str(_written(tmp_path, _LEADS_TO[what])), inputs_from([], environment={}), problems)
    assert problems.errors


@pytest.mark.parametrize("what", _OTHERWISE)
def test_what_may_follow_from_something_else_stays_an_error(what: str, tmp_path: Path) -> None:
    (problem,) = _checked(_written(tmp_path, _OTHERWISE[what]))
    assert problem.severity is Severity.ERROR


@pytest.mark.parametrize("what", ["a key", "a sum", "an end"])
def test_so_it_is_in_an_included_file(what: str, tmp_path: Path) -> None:
    _written(tmp_path, _LEADS_TO[what])
    outer = tmp_path / "outer.launch.yaml"
    outer.write_text("launch: [include: {file: $(dirname)/a.launch.py}]\n")
    (problem,) = _checked(outer)
    assert (problem.severity, problem.code) == (Severity.NOTE, "ORC021"), problem
    assert problem.included_from


def _written(folder: Path, body: str) -> Path:
    path = folder / "a.launch.py"
    end = "" if "return LaunchDescription" in body else "\nreturn LaunchDescription([])"
    lines = f"{body}{end}".splitlines()
    path.write_text(_HEAD + "".join(f"    {line}\n" for line in lines))
    return path


def _checked(path: Path) -> tuple[Problem, ...]:
    (target,) = targets([str(path)])
    finding, _ = Looker(inputs_from([], environment={})).look(target)
    return finding.problems
