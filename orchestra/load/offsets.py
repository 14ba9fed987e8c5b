"""Where the characters of a YAML scalar's value stand in the file: through quotes, escapes, folding and indentation."""

from __future__ import annotations

from bisect import bisect_right
from functools import cached_property
from itertools import accumulate, count
from operator import add
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.location import offsets_of, stretch, whole_of
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.location import Span

_BREAKS = "\n\r\x85\u2028\u2029"
_BREAK = pattern(f"\r\n|[{_BREAKS}]")
_PROPERTIES = pattern(r"([!&]\S*\s+)*")
_HEXADECIMAL = {"x": 2, "u": 4, "U": 8}


@dataclass(frozen=True)
class Source:
    """The text of a file."""

    file: str
    text: str

    @cached_property
    def lines(self) -> tuple[int, ...]:
        """The offsets at which its lines begin."""
        text = self.text
        if text.isascii() and "\r" not in text:  # as nearly all are
            *lines, _ = text.split("\n")
            return tuple(map(add, accumulate(map(len, lines), initial=0), count()))
        return (0, *(found.end() for found in _BREAK.finditer(text)))

    def place(self, offset: int) -> tuple[int, int]:
        """Return the 1-based line and column of an offset in code points."""
        line = bisect_right(self.lines, offset)
        return line, offset - self.lines[line - 1] + 1

    def offset(self, line: int, column: int) -> int:
        """Return the offset of a place; a place behind the text, where a parser may see its end, is the end."""
        begin = self.lines[line - 1] if line <= len(self.lines) else len(self.text)
        return min(begin + column - 1, len(self.text))

    def span(self, start: int, end: int) -> Span:
        """Return the span between two offsets."""
        return stretch(self, start, end)


def source(file: str, text: str) -> Source:
    """Return the text of a file."""
    return Source(file, text)


def is_on_one_line(span: Span) -> bool:
    """Return whether a span begins and ends on one line; the lines of its file are not counted for that."""
    whole, offsets = whole_of(span), offsets_of(span)
    if type(whole) is not Source or offsets is None:
        return span.line == span.end_line
    begin, end = offsets
    # What ends a line is not printable.
    return whole.text[begin:end].isprintable() or _BREAK.search(whole.text, begin, end) is None


def spans_of(
    whole: Source, start: int, end: int, value: str, style: str | None
) -> Callable[[int, int], Span]:
    """Return a function from offsets in the value to spans in the file. The alignment is made when first asked."""
    inset = 1 if style in ('"', "'") else 0
    if whole.text[start + inset : end - inset] == value:  # written as it reads
        return lambda first, last: whole.span(start + inset + first, start + inset + last)
    aligned: list[int] = []

    def spans(first: int, last: int) -> Span:
        if not aligned:
            aligned.extend(_aligned(whole.text, start, end, value, style))
        begin = aligned[min(first, len(aligned) - 1)]
        stop = aligned[last - 1] + 1 if last > first else begin
        return whole.span(begin, max(begin, stop))

    return spans


def _aligned(text: str, start: int, end: int, value: str, style: str | None) -> list[int]:
    """Return for each character of the value, and for its end, the offset in the text."""
    start += len(_PROPERTIES.match(text, start, end)[0])  # type: ignore[index]  # matches nothing at least
    if style in ('"', "'"):
        start, end = start + 1, end - 1
    elif style in ("|", ">"):
        start = next((at + 1 for at in range(start, end) if text[at] in _BREAKS), end)
    offsets, at = [], start
    for character in value:
        at, width = _next(text, at, end, character, style)
        offsets.append(min(at, max(end - 1, start)))
        at += width
    return [*offsets, min(at, end)]


def _next(text: str, at: int, end: int, character: str, style: str | None) -> tuple[int, int]:
    """Return where the next character of the value stands at or after an offset, and how wide it is written."""
    while at < end:
        if style == '"' and text[at] == "\\":
            width = 2 + _HEXADECIMAL.get(text[at + 1], 0)
            if text[at + 1] not in _BREAKS:
                return at, width
            at += 1
        if style == "'" and text.startswith("''", at) and character == "'":
            return at, 2
        if text[at] == character or (text[at] in _BREAKS and character in " \n"):
            return at, 1
        at += 1
    return at, 0
