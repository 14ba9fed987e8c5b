"""Marks of a merge whose conflict was never settled, which stand alone on lines from their beginning on."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.load.mended import Mend

if TYPE_CHECKING:
    from collections.abc import Iterator

TOLD: Final = "a conflict of a merge is left here"
_FIRST: Final = re.compile(r"^(<{7})(?: .*)?$", re.MULTILINE)
_LATER: Final = re.compile(r"^(={7}|>{7}|\|{7})(?: .*)?$", re.MULTILINE)
_BETWEEN: Final = re.compile(r"^={7}.*\n", re.MULTILINE)
_MERGED: Final = re.compile(r"^>{7}.*$", re.MULTILINE)


def conflict_in(text: str) -> tuple[int, int] | None:
    """Return the range of the first mark of a conflict, of the later ones only where none begins; None without any."""
    found = _FIRST.search(text) or _LATER.search(text)
    return None if found is None else found.span(1)


def is_mark(line: str) -> bool:
    """Return whether a line is a mark of a conflict."""
    return _FIRST.fullmatch(line) is not None or _LATER.fullmatch(line) is not None


def settled(text: str, begin: int) -> Iterator[Mend]:
    """Take the first side of a conflict that begins at an offset; of what is left of one, take the marks away."""
    if not _FIRST.match(text, begin):
        marks = [found.span() for found in _LATER.finditer(text, begin)]
        if marks:
            yield Mend(tuple((*mark, "") for mark in marks), (marks[0][0], marks[-1][1]))
        return
    # One after the other: an expression for all of it tries each line between with all that follow.
    between = _BETWEEN.search(text, begin)
    end = None if between is None else _MERGED.search(text, between.end())
    if between is not None and end is not None:
        first = (text.find("\n", begin) + 1) or len(text)
        yield Mend(((begin, first, ""), (between.start(), end.end(), "")), (begin, end.end()))
