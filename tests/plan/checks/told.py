"""What is said about a description that a test writes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from orchestra.errors import Code
from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from orchestra.location import Span

# A code, the text that it marks, what should stand instead.
Told: TypeAlias = tuple[Code, str, str | None]


def told(folder: Path, written: str | dict[str, str]) -> list[Told]:
    """Return what is wrong with a launch file, or the actions of one, in the order in which people see it."""
    files = {"main.launch.yaml": f"launch:\n{written}"} if isinstance(written, str) else written
    problems = outcome(folder, files, launching=False).problems.ordered
    return [
        (problem.code, marked(problem.span), problem.suggestion)
        for problem in problems
        if problem.span is not None
    ]


def marked(span: Span) -> str:
    """Return the text of a span, of its first line where it has several."""
    line = Path(span.file).read_text("utf-8").split("\n")[span.line - 1]
    return line[span.column - 1 : span.end_column - 1 if span.end_line == span.line else None]


def node(name: str, **keys: object) -> str:
    """Return the line of a node that starts a program of the system."""
    more = "".join(f", {key}: {value}" for key, value in keys.items())
    return f"- node: {{exec: sleep, name: {name}{more}}}\n"
