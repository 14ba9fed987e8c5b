"""Python launch files that want devices, networks and programs which only another machine has."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Final

import pytest

from orchestra.cli.look.looker import Looker
from orchestra.cli.targets import targets
from orchestra.errors import Code, Problem, Problems, Severity
from orchestra.pipeline import collect, inputs_from

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

_HEAD: Final = """\
import glob
import os
import shutil
import socket
import subprocess
import sys
from pathlib import Path
from launch import LaunchDescription
from launch.actions import *

def generate_launch_description():
"""
# No machine has what is called qq.
_WANTS = {
    "an item": (Code.MISSING_FILE, "port = glob.glob('/dev/qq*')[0]"),
    "an item of a variable": (Code.MISSING_FILE, "ports = sorted(glob.glob('/dev/qq*'))\nport = ports[-1]"),
    "the largest": (Code.MISSING_FILE, "port = max(glob.glob('/dev/qq*'))"),
    "the next": (
        Code.MISSING_FILE,
        "port = next(name for name in os.listdir('/dev') if name.startswith('qq'))",
    ),
    "a path": (Code.MISSING_FILE, "port = list(Path('/dev').glob('qq*'))[0]"),
    "a function": (Code.MISSING_FILE, "def port():\n    return glob.glob('/dev/qq*')[0]\nport()"),
    "a refusal": (
        Code.MISSING_FILE,
        "port = '/dev/qq'\nif not os.path.exists(port):\n    raise RuntimeError('no')",
    ),
    "an end": (Code.MISSING_FILE, "if not glob.glob('/dev/qq*'):\n    sys.exit('no')"),
    "an assertion": (Code.MISSING_FILE, "assert Path('/dev/qq').exists(), 'no'"),
    "an interface": (Code.COMMAND_FAILED, "index = socket.if_nametoindex('qq')"),
    "a program": (Code.MISSING_EXECUTABLE, "path = shutil.which('qq-nobody-has-this').strip()"),
    "a shell": (
        Code.MISSING_EXECUTABLE,
        "text = subprocess.check_output('qq-nobody-has-this 2> /dev/null', shell=True)",
    ),
}
# What is wrong with these is wrong on any machine.
_OTHERWISE = {
    "files of the project": "name = glob.glob(os.path.dirname(__file__) + '/*.qq')[0]",
    "a list of its own": "name = [1, 2][2]",
    "more than there are": "name = glob.glob('/dev/null')[3]",
    "a number that is none": "number = int(os.listdir('/dev')[0] + 'x')",
    "a refusal of something else": "assert len('/dev/qq') > 20, 'short'",
    "a refusal of what is there": "if os.path.exists('/dev/null'):\n    raise RuntimeError('no')",
    "what a program is given": "text = subprocess.check_output([sys.executable, '-c', 'raise SystemExit(1)'])",
}


@pytest.mark.parametrize("what", _WANTS)
def test_what_a_machine_lacks_is_a_note(what: str, tmp_path: Path) -> None:
    code, body = _WANTS[what]
    (problem,) = _checked(_written(tmp_path, body))
    assert (problem.severity, problem.code) == (Severity.NOTE, code), problem
    assert problem.message.endswith("on this machine")


@pytest.mark.parametrize("what", ["an item", "an interface", "a refusal"])
def test_a_plan_needs_it(what: str, tmp_path: Path) -> None:
    problems = Problems()
    collect(str(_written(tmp_path, _WANTS[what][1])), inputs_from([], environment={}), problems)
    assert problems.errors


@pytest.mark.parametrize("what", _OTHERWISE)
def test_what_is_wrong_anywhere_is_an_error(what: str, tmp_path: Path) -> None:
    (problem,) = _checked(_written(tmp_path, _OTHERWISE[what]))
    assert problem.severity is Severity.ERROR


def test_what_a_program_tells_of_the_machine_is_a_note(tmp_path: Path) -> None:
    program = tmp_path / "lsusb"
    program.write_text(f"#!{sys.executable}\nraise SystemExit(1)\n")
    program.chmod(0o755)
    path = _written(tmp_path, "text = subprocess.check_output(['lsusb', '-d', 'qq'])")
    (problem,) = _checked(path, {"PATH": str(tmp_path)})
    assert (problem.severity, problem.code) == (Severity.NOTE, Code.COMMAND_FAILED), problem


def _written(folder: Path, body: str) -> Path:
    path = folder / "a.launch.py"
    lines = [*body.splitlines(), "return LaunchDescription([])"]
    path.write_text(_HEAD + "".join(f"    {line}\n" for line in lines))
    return path


def _checked(path: Path, environment: Mapping[str, str] | None = None) -> tuple[Problem, ...]:
    (target,) = targets([str(path)])
    finding, _ = Looker(inputs_from([], environment=environment or {})).look(target)
    return finding.problems
