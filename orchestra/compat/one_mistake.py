"""Problems of Python files that are one mistake: lists side by side, code that runs again, what an exception causes."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.compat.source_text import text_at
from orchestra.errors import Code, Severity
from orchestra.fields import replace

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from orchestra.errors import Problem
    from orchestra.location import Span

_LISTS: Final = re.compile(r"an action is expected here, this is a (?:list|tuple)")
_COMMA: Final = re.compile(r"\s*,\s*")
_OF_VALUES: Final = frozenset({Code.BAD_NAME, Code.MISSING_EXECUTABLE, Code.MISSING_FILE, Code.WRONG_TYPE})
_VALUES: Final = re.compile(r"'[^']*'|\S*/[^\s:,]*|\d+")
_FEW: Final = 5
_MESSAGE: Final = "actions are expected here, these are lists"


def together(problems: Iterable[Problem]) -> Callable[[Problem], Problem | None]:
    """Return what makes one problem of those that stand side by side, and leaves any other as it is."""
    lists = [problem for problem in problems if _is_list(problem)]
    lists.sort(
        key=lambda problem: (
            (problem.span.file, problem.span.line, problem.span.column) if problem.span else ()
        )
    )
    made: dict[int, Problem | None] = {}
    first: Problem | None = None
    for problem in lists:
        joined = None if first is None else _joined(made.get(id(first)) or first, problem)
        if first is None or joined is None:
            first = problem
        else:
            made[id(first)], made[id(problem)] = joined, None
    return lambda problem: made.get(id(problem), problem)


def behind_exceptions(problems: Iterable[Problem]) -> Callable[[Problem], Problem | None]:
    """Return what leaves out the problems of a text that has raised an exception: they are those of what was meant."""
    raised: dict[str, list[Span]] = {}
    adding: set[tuple[str, int, int]] = set()
    for problem in problems:
        is_of_code = problem.code in (Code.USER_CODE, Code.SYNTAX) and problem.severity is Severity.ERROR
        if is_of_code and problem.span is not None and problem.span.file.endswith(".py"):
            raised.setdefault(problem.span.file, []).append(problem.span)
            if problem.suggestion == "add_action":
                adding.add((problem.span.file, problem.span.end_line, problem.span.end_column + 1))

    def amended(problem: Problem) -> Problem | None:
        span = problem.span
        if span is None or problem.code in (Code.USER_CODE, Code.SYNTAX):
            return problem
        if _LISTS.match(problem.message) and (span.file, span.line, span.column) in adding:
            return None  # `extend`, which was written, takes a list
        return None if any(_holds(outer, span) for outer in raised.get(span.file, ())) else problem

    return amended


def corrected_alike(problems: Iterable[Problem]) -> Callable[[Problem], Problem | None]:
    """Return what leaves one problem of those that are mended alike: of code that runs again for other values.

    Where it is not known how they are mended, the others become notes of the first.
    """
    first: dict[tuple[object, ...], Problem] = {}
    notes: dict[int, list[str]] = {}
    for problem in problems:
        if problem.span is None or not problem.span.file.endswith(".py"):
            continue
        known = first.setdefault(_mended(problem), problem)
        if known is not problem and known.suggestion is None and len(notes.get(id(known), ())) < _FEW:
            notes.setdefault(id(known), []).append(f"here, too: {problem.message}")

    def amended(problem: Problem) -> Problem | None:
        if first.get(_mended(problem), problem) is not problem:
            return None
        more = notes.get(id(problem))
        return problem if more is None else replace(problem, notes=(*problem.notes, *more))

    return amended


def _mended(problem: Problem) -> tuple[object, ...]:
    """Return what is the same of problems that are mended alike."""
    if problem.suggestion is not None:
        return (problem.code, problem.span, problem.suggestion)
    is_of_value = problem.code in _OF_VALUES
    return (problem.code, problem.span, _VALUES.sub("", problem.message) if is_of_value else problem.message)


def _holds(outer: Span, inner: Span) -> bool:
    begins = (outer.line, outer.column) <= (inner.line, inner.column)
    return begins and (inner.end_line, inner.end_column) <= (outer.end_line, outer.end_column)


def _is_list(problem: Problem) -> bool:
    is_told = problem.code is Code.WRONG_TYPE and _LISTS.match(problem.message) is not None
    return is_told and problem.span is not None and problem.suggestion is not None


def _joined(one: Problem, other: Problem) -> Problem | None:
    """Return two problems as one where nothing but a comma is between them."""
    if one.span is None or other.span is None or one.span.file != other.span.file:
        return None
    file, between = str(Path(one.span.file).absolute()), _between(one.span, other.span)
    if one.included_from != other.included_from or _COMMA.fullmatch(text_at(file, between)) is None:
        return None
    span = replace(one.span, end_line=other.span.end_line, end_column=other.span.end_column)
    return replace(one, message=_MESSAGE, span=span, suggestion=f"{one.suggestion}, {other.suggestion}")


def _between(one: Span, other: Span) -> Span:
    return replace(
        one, line=one.end_line, column=one.end_column, end_line=other.line, end_column=other.column
    )
