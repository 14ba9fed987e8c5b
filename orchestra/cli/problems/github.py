"""Problems as workflow commands, which GitHub shows beside the lines of a change.

Source: docs.github.com, "Workflow commands for GitHub Actions", setting an error, a warning or a notice message.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.errors import Severity

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.cli.colour import Paint
    from orchestra.cli.problems.sources import Sources
    from orchestra.errors import Problem


_COMMANDS: Final = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "notice"}


def render(problems: Sequence[Problem], _sources: Sources, _paint: Paint) -> str:
    """Return one command per problem."""
    return "".join(f"{_command(problem)}\n" for problem in problems)


def _command(problem: Problem) -> str:
    properties = ",".join(f"{name}={_property(str(value))}" for name, value in _properties(problem))
    message = "\n".join(_message(problem))
    return f"::{_COMMANDS[problem.severity]} {properties}::{_data(message)}"


def _properties(problem: Problem) -> Iterator[tuple[str, str | int]]:
    """Yield the properties; GitHub takes columns only where the span ends on its first line, and counts the last."""
    span = problem.span
    if span:
        yield "file", span.file
        yield "line", span.line
        yield "endLine", span.end_line
        if span.line == span.end_line:
            yield "col", span.column
            yield "endColumn", max(span.column, span.end_column - 1)
    yield "title", problem.code.value


def _message(problem: Problem) -> Iterator[str]:
    yield problem.message
    if problem.suggestion is not None:
        yield f"did you mean '{problem.suggestion}'?"
    yield from problem.notes
    for include in problem.included_from:
        yield f"included from {include}"


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
