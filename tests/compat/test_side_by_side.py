"""An action that code starts again and again: the code is looked at once, however often that is."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.compat import side_by_side
from orchestra.errors import Code, Problems
from orchestra.pipeline import collect, inputs_from

if TYPE_CHECKING:
    from pathlib import Path

    import pytest

_FILE: Final = """\
from launch import LaunchDescription
from launch.actions import ExecuteProcess


def generate_launch_description():
    again = ExecuteProcess(cmd=["true"])
    return LaunchDescription([{}])
"""


def _told(folder: Path, items: str, monkeypatch: pytest.MonkeyPatch) -> tuple[list[str], int]:
    """Return what is told of actions that are started twice, and how often the code was looked at for that."""
    looks, second_use = 0, side_by_side.second_use

    def looked(made: object) -> object:
        nonlocal looks
        looks += 1
        return second_use(made)  # type: ignore[arg-type] # it is handed on

    monkeypatch.setattr(side_by_side, "second_use", looked)
    path, problems = folder / "main.launch.py", Problems()
    path.write_text(_FILE.format(items), "utf-8")
    collect(str(path), inputs_from([], environment={"PATH": "/usr/bin:/bin"}), problems)
    return [str(problem.span) for problem in problems if problem.code is Code.DUPLICATE_NODE], looks


def test_an_action_that_stands_in_a_list_thrice_is_told_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    told, looks = _told(tmp_path, "again, again, again", monkeypatch)
    assert [place.partition(":")[2] for place in told] == ["7:38"]
    assert looks == 1


def test_an_action_that_a_loop_repeats_is_looked_for_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert _told(tmp_path, "*(again for _ in range(9))", monkeypatch) == ([], 1)
