"""What is found in one file by itself, before the files of a set are seen together."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.dataclass import dataclass
from orchestra.errors import Code, Problem, Severity
from orchestra.location import Span

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True, slots=True)
class Finding:
    """What a look at one file has given.

    `included` are the files that were included, `named` those that includes name whatever their conditions say; all
    are real paths. `silencing` has file and line of the comments that have silenced something, `comments` tells
    whether the file has such comments.
    """

    path: str
    problems: tuple[Problem, ...]
    included: frozenset[str] = frozenset()
    named: frozenset[str] = frozenset()
    silencing: frozenset[tuple[str, int]] = frozenset()
    comments: bool = False

    def as_data(self) -> dict[str, Any]:
        """Return it as JSON data."""
        return {
            "path": self.path,
            "problems": [_problem_data(problem) for problem in self.problems],
            "included": sorted(self.included),
            "named": sorted(self.named),
            "silencing": sorted(self.silencing),
            "comments": self.comments,
        }

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> Finding:
        """Return what was written as JSON data; raises `KeyError`, `TypeError` and `ValueError` for anything else."""
        return cls(
            data["path"],
            tuple(_problem(item) for item in data["problems"]),
            frozenset(data["included"]),
            frozenset(data["named"]),
            frozenset((file, line) for file, line in data["silencing"]),
            data["comments"],
        )


def _problem_data(problem: Problem) -> list[Any]:
    return [
        problem.code.value,
        problem.severity.value,
        problem.message,
        None if problem.span is None else _span_data(problem.span),
        [_span_data(span) for span in problem.included_from],
        problem.suggestion,
        list(problem.notes),
    ]


def _problem(data: list[Any]) -> Problem:
    code, severity, message, span, included_from, suggestion, notes = data
    return Problem(
        Code(code),
        Severity(severity),
        message,
        None if span is None else Span(*span),
        tuple(Span(*item) for item in included_from),
        suggestion,
        tuple(notes),
    )


def _span_data(span: Span) -> list[Any]:
    return [span.file, span.line, span.column, span.end_line, span.end_column]
