"""Words in a range of the user's source text."""

from __future__ import annotations

import linecache
import re
from typing import TYPE_CHECKING, Final

from orchestra.location import Span

if TYPE_CHECKING:
    from collections.abc import Iterator

_QUOTED: Final = re.compile(r"""(["'])((?:(?!\1)[^\\\n])+)\1""")


def text_at(file: str, span: Span) -> str:
    """Return the text of a range of a file."""
    return "\n".join(text[begin:] for _, begin, text in _lines(file, span))


def word_in(file: str, span: Span, word: str) -> Span | None:
    """Return where a name stands in a range of a file, the last time it does; None where it does not."""
    found = [
        _part(span, line, match.start(), match.end())
        for line, begin, text in _lines(file, span)
        for match in re.compile(rf"(?<!\w){re.escape(word)}(?!\w)").finditer(text, begin)
    ]
    return found[-1] if found else None


def part_in(file: str, span: Span, text: str) -> Span | None:
    """Return where a text stands in a range of a file, the first time it does; None where it does not."""
    for line, begin, source in _lines(file, span):
        at = source.find(text, begin) if text else -1
        if at >= 0:
            return _part(span, line, at, at + len(text))
    return None


def quoted_in(file: str, span: Span) -> dict[str, Span]:
    """Return the texts in quotes in a range of a file, and where they stand without them, the first time they do."""
    found: dict[str, Span] = {}
    for line, begin, text in _lines(file, span):
        for match in _QUOTED.finditer(text, begin):
            found.setdefault(match[2], _part(span, line, match.start(2), match.end(2)))
    return found


def _lines(file: str, span: Span) -> Iterator[tuple[int, int, str]]:
    """Yield number, first column from 0, and text up to the last column of the lines of a range."""
    for line in range(span.line, span.end_line + 1):
        text = linecache.getline(file, line).rstrip("\n")
        begin = span.column - 1 if line == span.line else 0
        yield line, begin, text[: span.end_column - 1] if line == span.end_line else text


def _part(span: Span, line: int, begin: int, end: int) -> Span:
    return Span(span.file, line, begin + 1, line, end + 1)
