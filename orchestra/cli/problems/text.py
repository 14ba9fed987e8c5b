"""Problems for people: place, what is wrong, the line with a mark under it, what would be right, the includes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.cli.problems.snippet import printable, snippet
from orchestra.errors import Problem, Severity

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.cli.colour import Paint
    from orchestra.cli.problems.sources import Sources
    from orchestra.location import Span


def render(problems: Sequence[Problem], sources: Sources, paint: Paint) -> str:
    """Return the problems as text, an empty line between two, with a line of counts at the end."""
    if not problems:
        return ""
    return "\n".join([*blocks(problems, sources, paint), f"{counts(problems)}\n"])


def blocks(problems: Sequence[Problem], sources: Sources, paint: Paint) -> list[str]:
    """Return the lines of each."""
    return ["".join(f"{line}\n" for line in _block(problem, sources, paint)) for problem in problems]


def counts(problems: Sequence[Problem]) -> str:
    """Return how many there are of each severity: `2 errors, 1 warning`."""
    numbers = [(sum(problem.severity is severity for problem in problems), severity) for severity in Severity]
    return ", ".join(f"{number} {severity}{'s' * (number != 1)}" for number, severity in numbers if number)


def headline(problem: Problem, paint: Paint) -> str:
    """Return where something is, how grave, and what; that of a note is faint as a whole."""
    place, word = f"{problem.span}: " if problem.span else "", f"{problem.severity}:"
    message, code = printable(problem.message), f"[{problem.code}]"
    if problem.severity is Severity.NOTE:
        return paint("note", f"{place}{word} {message} {code}")
    return f"{paint('strong', place)}{paint(problem.severity, word)} {paint('strong', message)} {code}"


def _block(problem: Problem, sources: Sources, paint: Paint) -> Iterator[str]:
    yield headline(problem, paint)
    if problem.span:
        yield from _source(problem.span, problem.severity, sources, paint)
    if problem.suggestion is not None:
        yield f"{paint('help', 'help:')} did you mean '{printable(problem.suggestion)}'?"
    for note in problem.notes:
        yield f"{paint('strong', 'note:')} {printable(note)}"
    for include in problem.included_from:
        yield paint("faint", f"included from {include}")


def _source(span: Span, severity: Severity, sources: Sources, paint: Paint) -> Iterator[str]:
    """Yield the first line of the span with marks; a span of several lines is marked to the end of its first."""
    line = sources(span.file, span.line)
    if line is None:
        return
    end_column = span.end_column if span.end_line == span.line else None
    shown = snippet(line, span.column, end_column)
    number = f"{span.line:>5}"
    yield f"{paint('faint', number + ' |')} {shown.source}"
    more = " ..." if span.end_line > span.line else ""
    yield f"{paint('faint', ' ' * len(number) + ' |')} {paint(severity.value, shown.marks + more)}"
