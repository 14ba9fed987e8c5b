"""Launch files written in a test, checked as `orchestra check` does."""

from __future__ import annotations

import os
from contextlib import contextmanager
from dataclasses import replace
from importlib import invalidate_caches
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra import pipeline

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.errors import Problem


@contextmanager
def _working_in(folder: Path) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        patch.syspath_prepend(str(folder))
        invalidate_caches()
        yield


def checked(folder: Path, files: dict[str, str], *words: str) -> tuple[Problem, ...]:
    """Write files, the first of which is launched; return what is wrong. Packages beside it can be imported."""
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, "utf-8")
    with _working_in(folder):
        inputs = replace(pipeline.inputs_from(words, environment=os.environ), launching=False)
        return pipeline.check(str(folder / next(iter(files))), inputs)


def told(problems: tuple[Problem, ...]) -> list[str]:
    """Return each problem as `CODE file:line:column severity message => suggestion`."""
    return [
        f"{problem.code} {problem.span} {problem.severity} {problem.message}"
        + (f" => {problem.suggestion}" if problem.suggestion is not None else "")
        for problem in problems
    ]


def marked(problem: Problem, folder: Path) -> str:
    """Return the text that a problem points at."""
    assert problem.span is not None
    span = problem.span
    lines = (folder / Path(span.file).name).read_text("utf-8").splitlines()
    assert span.line == span.end_line
    return lines[span.line - 1][span.column - 1 : span.end_column - 1]
