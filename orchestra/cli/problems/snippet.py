"""One line of a source file with marks under a part of it, as a terminal shows it."""

from __future__ import annotations

import unicodedata
from itertools import accumulate

from orchestra.dataclass import dataclass

_TAB = 4
_WIDEST = 140
_BEFORE = 40  # cells kept before the mark where a line is cut
_FAR = 1_000  # characters on either side of the mark's beginning that are looked at: lines may have millions
_REPLACEMENT = "\ufffd"
_CUT = "…"


@dataclass(frozen=True, slots=True)
class Snippet:
    """A source line as shown, and the line of marks under it."""

    source: str
    marks: str


def snippet(line: str, column: int, end_column: int | None) -> Snippet:
    """Mark the columns of a line (1-based, the end exclusive, None for the rest of the line).

    Tabs become spaces, characters that would move the cursor become U+FFFD, wide characters take two cells, and a
    line that is too long for any terminal is cut around the mark.
    """
    hidden = max(0, column - 1 - _FAR)
    beyond = len(line) > column + _FAR
    shown = _shown(line[hidden : column + _FAR])
    column, end_column = column - hidden, None if end_column is None else end_column - hidden
    cells = list(accumulate((_width(piece) for piece in shown), initial=0))
    first = min(column - 1, len(shown))
    last = len(shown) if end_column is None else min(end_column - 1, len(shown))
    left, right = _window(cells, first, last)
    cut = left > 0 or hidden > 0
    source = _CUT * cut + "".join(shown[left:right]) + _CUT * (beyond or right < len(shown))
    before = cells[first] - cells[left] + cut
    marked = cells[min(last, right)] - cells[first] if last > first else 0
    return Snippet(source.rstrip(), " " * before + "^" * max(marked, 1))


def printable(text: str) -> str:
    """Return a text of any origin so that no terminal takes a part of it for a command; its lines stay lines."""
    return "".join(character if character == "\n" else _printable(character, 0) for character in text)


def _shown(line: str) -> list[str]:
    """Return what to print for each character."""
    shown: list[str] = []
    cell = 0
    for character in line:
        shown.append(_printable(character, cell))
        cell += _width(shown[-1])
    return shown


def _printable(character: str, cell: int) -> str:
    if character == "\t":
        return " " * (_TAB - cell % _TAB)
    return _REPLACEMENT if unicodedata.category(character) in ("Cc", "Cf", "Cs", "Zl", "Zp") else character


def _width(text: str) -> int:
    return sum(_cells(character) for character in text)


def _cells(character: str) -> int:
    """Return how many cells of a terminal a character takes (Unicode annex 11)."""
    if unicodedata.combining(character) or unicodedata.category(character) in ("Mn", "Me"):
        return 0
    return 2 if unicodedata.east_asian_width(character) in ("W", "F") else 1


def _window(cells: list[int], first: int, last: int) -> tuple[int, int]:
    """Return the range of characters to show so that the mark's beginning is in sight."""
    end = len(cells) - 1
    if cells[end] <= _WIDEST:
        return 0, end
    left = next(index for index in range(end + 1) if cells[index] >= cells[first] - _BEFORE)
    right = (
        next((index for index in range(left, end + 1) if cells[index] > cells[left] + _WIDEST), end + 1) - 1
    )
    return left, max(right, min(first + 1, last, end))
