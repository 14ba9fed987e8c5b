"""Aliases in parameter files: what they stand for, so that it can be written in their place."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from orchestra.fields import replace
from orchestra.patterns import pattern
from orchestra.resolve.rcl.reader import ALIAS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.errors import Problem

_ALIAS = pattern(r"\*([^\s,\[\]{}]+)")
_QUOTED = r"\"(?:[^\"\\]|\\.)*\"|'[^']*'|\[[^\[\]{}]*\]"
_IN_BRACKETS = rf"({_QUOTED}|[^\s,\[\]{{}}\"'#&*|>!](?:(?! #|: )[^,\[\]{{}}])*)"
_ALONE = rf"({_QUOTED}|[^\s,\[\]{{}}\"'#&*|>!](?:(?! #|: ).)*)\s*(?:#|$)"


def repeated(problem: Problem, lines: Sequence[str]) -> Problem:
    """Return the problem of an alias with the value that it stands for, if that is on one line."""
    span = problem.span
    if span is None or not problem.message.startswith(ALIAS):
        return problem
    name = _ALIAS.match(lines[span.line - 1], span.column - 1)
    if name is None:
        return problem
    anchor = re.compile(rf"(?<![^\s\[,])&{re.escape(name[1])}[ \t]+")
    for line in reversed([*lines[: span.line - 1], lines[span.line - 1][: span.column - 1]]):
        for found in anchor.finditer(line):
            around = line[: found.start()]
            written = re.compile(_IN_BRACKETS if "[" in around or "{" in around else _ALONE).match(
                line, found.end()
            )
            return problem if written is None else replace(problem, suggestion=written[1].rstrip())
    return problem
