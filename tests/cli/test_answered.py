"""`orchestra plan` answers again what it has answered before, as long as it would come to the same."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import TYPE_CHECKING, NamedTuple

import pytest

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

_FILE = """\
launch:
  - arg: {name: robot, default: $(env ROBOT nobody)}
  - executable: {cmd: sleep 1, name: $(var robot)}
  - executable: {cmd: sleep 2, name: other}
  - include: {file: part.launch.py}
"""
_PART = "from launch import LaunchDescription\n\ndef generate_launch_description():\n    return LaunchDescription()\n"
# Of what makes a plan, nothing else imports it.
_MAKER = "orchestra.pipeline"


class Answer(NamedTuple):
    """What one command has written, and whether it made the plan for that."""

    status: int
    out: bytes
    told: str
    made: bool


class Place:
    """A folder with a launch file, and a cache."""

    def __init__(self, folder: Path) -> None:
        # Not beside the files: what is new in a folder that code is imported from may change the plan.
        self.cache = folder / "cache"
        self.folder = folder / "files"
        self.folder.mkdir()
        self.file = self.folder / "main.launch.yaml"
        self.file.write_text(_FILE)
        (self.folder / "part.launch.py").write_text(_PART)

    def plan(self, *words: str, environment: Mapping[str, str] | None = None) -> Answer:
        """Run `orchestra plan` in it."""
        cache = {"ORCHESTRA_CACHE": str(self.cache), **(environment or {})}
        ended = subprocess.run(
            [sys.executable, "-X", "importtime", "-m", "orchestra", "plan", "main.launch.yaml", *words],
            cwd=self.folder,
            env={**os.environ, **cache},
            capture_output=True,
            check=False,
        )
        lines = ended.stderr.decode().splitlines(keepends=True)
        imported = {line.rpartition("|")[2].strip() for line in lines if line.startswith("import time:")}
        told = "".join(line for line in lines if not line.startswith("import time:"))
        return Answer(ended.returncode, ended.stdout, told, _MAKER in imported)


@pytest.fixture
def place(tmp_path: Path) -> Place:
    return Place(tmp_path)


@pytest.mark.parametrize(
    "words", [(), ("--format", "json"), ("--explain", "/nobody"), ("robot:=\udcff",)], ids=ascii
)
def test_the_same_words_get_the_same_answer_without_a_plan_being_made(
    place: Place, words: tuple[str, ...]
) -> None:
    first, second = place.plan(*words), place.plan(*words)
    assert (first.status, first.made) == (0, True)
    assert second == first._replace(made=False)


def test_other_words_other_colours_and_other_variables_are_other_questions(place: Place) -> None:
    place.plan()
    assert b"robot7" in (named := place.plan("robot:=robot7")).out
    assert named.made
    assert b"\x1b[" in (painted := place.plan(environment={"FORCE_COLOR": "1"})).out
    assert painted.made
    assert b"robot8" in (other := place.plan(environment={"ROBOT": "robot8"})).out
    assert other.made


def test_a_changed_file_makes_another_plan(place: Place) -> None:
    place.plan()
    place.file.write_text(_FILE.replace("sleep 2", "sleep 3"))
    second = place.plan()
    assert second.made
    assert b"sleep 3" in second.out


def test_warnings_are_told_again_and_a_mistake_is_never_kept(place: Place) -> None:
    place.file.write_text(_FILE + "  - let: {name: unread, value: '$(var robot) '}\n")
    first, second = place.plan("more:=1"), place.plan("more:=1")
    assert (first.status, first.told) == (second.status, second.told)
    assert "more" in first.told
    place.file.write_text(_FILE + "  - nonsense: {}\n")
    assert [place.plan().made for _ in range(2)] == [True, True]


@pytest.mark.parametrize(
    "words", [("--no-cache",), ("--format", "sh"), ("--host",), ("--diff", "robot:=x")], ids=str
)
def test_what_is_of_this_moment_is_made_each_time(place: Place, words: tuple[str, ...]) -> None:
    answers = [place.plan(*words) for _ in range(2)]
    assert all(answer.made and answer.status == 0 for answer in answers), answers


def test_code_that_asks_the_time_is_asked_again(place: Place) -> None:
    (place.folder / "part.launch.py").write_text("import time\nNOW = time.time()\n" + _PART)
    assert [place.plan().made for _ in range(2)] == [True, True]
