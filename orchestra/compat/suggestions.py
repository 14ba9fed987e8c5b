"""Suggestions for Python files: what stands at a place is a whole expression there, of which one text is wrong."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.compat.source_text import quoted_in, text_at
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from orchestra.errors import Problem
    from orchestra.location import Span


def in_place(problem: Problem) -> Problem:
    """Return a problem whose suggestion can stand in place of its span; a note says it where no such text is found."""
    span, meant = problem.span, problem.suggestion
    if meant is None or span is None or not span.file.endswith(".py"):
        return problem
    wrong = _wrong(span, meant)
    if wrong is None:
        return replace(problem, suggestion=None, notes=(*problem.notes, f"did you mean '{meant}'?"))
    return replace(problem, span=wrong)


def _wrong(span: Span, meant: str) -> Span | None:
    """Return where the text stands that something else was meant by: nearest to it in the source text."""
    file = str(Path(span.file).absolute())
    if text_at(file, span).replace(".", "").isidentifier():
        return span
    quoted = quoted_in(file, span)
    text = nearest(meant, quoted)
    return None if text is None else quoted[text]
