"""Files of a check are read several after each other, before they are looked at one by one."""

from __future__ import annotations

import os
import warnings
from typing import TYPE_CHECKING

import pytest

from orchestra.cli.look.looker import Looker
from orchestra.cli.look.worker import Done, _results
from orchestra.cli.targets import Target
from orchestra.pipeline import inputs_from
from orchestra.resolve.python.codes import Codes, compile_ahead

if TYPE_CHECKING:
    from pathlib import Path

_SOUND = "launch:\n  - executable: {cmd: /bin/true}\n"


class _Work:
    """Notes what is asked of it, and at which place that is told to be."""

    def __init__(self) -> None:
        self.progress = memoryview(bytearray(16)).cast("d")
        self.progress[0] = 9.0
        self.asked: list[tuple[str, int, float]] = []

    def foresee(self, piece: int) -> None:
        self.asked.append(("foresee", piece, self.progress[0]))

    def turn(self, piece: int) -> Done:
        self.asked.append(("turn", piece, self.progress[0]))
        return Done(piece)

    def end(self) -> None:
        raise AssertionError("there may be more")


@pytest.mark.parametrize(
    ("pieces", "asked"),
    [
        ([5], [("turn", 5, 0)]),
        ([5, 3], [("foresee", 5, 0), ("foresee", 3, 1), ("turn", 5, 0), ("turn", 3, 1)]),
    ],
)
def test_it_is_told_which_piece_is_foreseen(pieces: list[int], asked: list[tuple[str, int, float]]) -> None:
    """So that the one that takes too long, or the process with it, is the one that is lost."""
    work = _Work()
    assert _results(pieces, work, work.progress, os.getpid()) == {"results": pieces, "last": False}
    assert work.asked == asked


@pytest.mark.parametrize("first", [_SOUND, "launch: [", "launch:\n  - unknown: {}\n"])
def test_what_has_changed_since_it_was_read_is_read_again(tmp_path: Path, first: str) -> None:
    file = tmp_path / "some.launch.yaml"
    file.write_text(first)
    target = Target(str(file), "launch")
    looker = Looker(inputs_from((), environment=os.environ))
    looker.read(target)
    file.write_text("launch:\n  - executable: {cmd: /bin/true, tpyo: 1}\n")
    finding, _ = looker.look(target)
    assert [problem.message.partition(" ")[0] for problem in finding.problems] == ["unknown"]


@pytest.mark.parametrize("name", ["gone.launch.yaml", "gone.launch.py"])
def test_what_cannot_be_read_is_told_when_it_is_looked_at(tmp_path: Path, name: str) -> None:
    target = Target(str(tmp_path / name), "launch")
    looker = Looker(inputs_from((), environment=os.environ))
    looker.read(target)
    finding, _ = looker.look(target)
    assert len(finding.problems) == 1


def test_what_compiling_warns_of_is_heard_by_who_asks_for_the_code(tmp_path: Path) -> None:
    file = tmp_path / "some.launch.py"
    file.write_text("name = 1 is 1\n")
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        compile_ahead(str(file))
        assert told == []
        Codes(None, str(file)).code(str(file), file.read_bytes())
    assert [warning.category for warning in told] == [SyntaxWarning]
