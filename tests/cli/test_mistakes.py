"""Every kind of mistake in one run, some behind an include: all are told at once, each where it is, and nothing runs."""

from __future__ import annotations

import json
from collections.abc import Callable
from subprocess import CompletedProcess
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

Command = Callable[..., CompletedProcess[str]]

_TOP = """\
launch:
  - arg: {name: world, default: arena}
  - executable: {cmd: echo one, nmae: one}
  - executable: {cmd: "echo $(vra world)", name: two}
  - executable: {cmd: echo three, name: three, name: four}
  - include: {file: robto.yaml}
  - include:
      file: robot.yaml
      arg: [{name: namespace, value: r1}]
"""
_ROBOT = """\
launch:
  - arg: {name: namespace}
  - node: {pkg: demo, exec: talker, name: talker, namespace: $(var namespace), respawn: perhaps}
  - node: {pkg: demo, exec: talker, name: listener, namespace: $(var namespace)}
  - node: {pkg: demo, exec: talker, name: listener, namespace: $(var namespace)}
"""
_TEXTS = {"top.yaml": _TOP, "robot.yaml": _ROBOT, "command line": "wolrd:=maze"}

# code, file, line, the last text of that line that is marked, suggestion
_EXPECTED = [
    ("ORC004", "top.yaml", 3, "nmae", "name"),  # a misspelt key
    ("ORC008", "top.yaml", 4, "vra", "var"),  # a misspelt substitution
    ("ORC003", "top.yaml", 5, "name", None),  # a key that stands twice
    ("ORC029", "top.yaml", 6, "robto.yaml", "robot.yaml"),  # a misspelt file
    ("ORC024", "command line", 1, "wolrd", "world"),  # a misspelt argument
    ("ORC005", "robot.yaml", 3, "perhaps", None),  # a wrong type, behind an include
    ("ORC050", "robot.yaml", 5, "listener", None),  # a node that is there twice, behind an include
]


def _line(file: str, number: int) -> str:
    return _TEXTS[file].splitlines()[number - 1]


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    (folder / "top.yaml").write_text(_TOP)
    (folder / "robot.yaml").write_text(_ROBOT)


def test_all_at_once_as_data(orchestra: Command, prefix: Path) -> None:
    found = orchestra("launch", "top.yaml", "wolrd:=maze", "--format", "json", AMENT_PREFIX_PATH=str(prefix))
    assert found.returncode == 2
    told = {
        (problem["code"], problem["file"], problem["line"], problem["column"], problem["suggestion"]): [
            place["line"] for place in problem["included_from"]
        ]
        for problem in json.loads(found.stderr)
    }
    assert told == {
        (code, file, number, _line(file, number).rindex(marked) + 1, suggestion): [7] * (file == "robot.yaml")
        for code, file, number, marked, suggestion in _EXPECTED
    }


def test_all_at_once_as_text(orchestra: Command, prefix: Path, home: Path) -> None:
    found = orchestra("launch", "top.yaml", "wolrd:=maze", AMENT_PREFIX_PATH=str(prefix))
    assert (found.returncode, found.stdout) == (2, "")
    *blocks, counts = found.stderr.split("\n\n")
    assert counts == f"{len(_EXPECTED)} errors\n"
    told = {block.partition(" error: ")[0]: block.splitlines() for block in blocks}
    for code, file, number, marked, suggestion in _EXPECTED:
        before = _line(file, number).rindex(marked)
        first, source, marks, *rest = told[f"{file}:{number}:{before + 1}:"]
        assert first.endswith(f" [{code}]")
        assert source == f"{number:>5} | {_line(file, number)}"
        assert marks == f"      | {' ' * before}{'^' * len(marked)}"
        assert (f"help: did you mean '{suggestion}'?" in rest) is (suggestion is not None)
        assert ("included from top.yaml:7:5" in rest) is (file == "robot.yaml")
    assert not home.exists()
