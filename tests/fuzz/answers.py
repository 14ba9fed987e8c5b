"""What a check of hostile files came to, and what must hold of every one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

# Of one check; on an idle machine it takes a hundredth of it.
_SECONDS = 10.0
_BYTES = 600 << 20


@dataclass(frozen=True)
class Answer:
    """The problems as in `--format json`, the traceback if there was one, and what the check cost."""

    problems: list[dict[str, Any]]
    raised: str | None
    status: int
    seconds: float
    grown: int

    @property
    def errors(self) -> list[dict[str, Any]]:
        """The problems that keep everything from starting."""
        return [problem for problem in self.problems if problem["severity"] == "error"]


Ask = Callable[..., Answer]


def assert_told_well(answer: Answer, files: dict[str, bytes]) -> None:
    """Nothing was raised, the cost is bounded, and every problem points into a file that is there."""
    assert answer.raised is None, answer.raised
    assert answer.status == 0, answer
    assert answer.seconds < _SECONDS, answer.seconds
    assert answer.grown < _BYTES, answer.grown
    splits = {name: _splits(content) for name, content in files.items()}
    for problem in answer.problems:
        assert problem["message"], problem
        assert problem["file"] in files, problem
        _assert_inside(problem, splits[problem["file"]])


def _splits(content: bytes) -> tuple[list[str], list[str]]:
    """Return the lines of a text, and those of what is no text: it has no other breaks than line feeds."""
    text = content.decode(_encoding(content), "replace")
    return text.splitlines() or [""], text.split("\n")


def _assert_inside(problem: dict[str, Any], splits: tuple[list[str], list[str]]) -> None:
    begin = (problem["line"], problem["column"])
    end = (problem["end_line"], problem["end_column"])
    assert (1, 1) <= begin <= end, problem
    assert end[0] <= len(splits[0]) + 1, problem
    assert any(begin[0] > len(lines) or begin[1] <= len(lines[begin[0] - 1]) + 2 for lines in splits), problem


def _encoding(content: bytes) -> str:
    for mark, name in ((b"\xff\xfe\0\0", "utf-32"), (b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16")):
        if content.startswith(mark):
            return name
    return "utf-8-sig"
