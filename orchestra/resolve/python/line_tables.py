"""The table of a code that says where each of its instructions stands, for a text in which columns have moved.

Its form is that of CPython 3.11 to 3.13 (`Objects/locations.md` there): entries of one byte that says the kind, and
of what a kind has besides. What the compiler writes for a place depends on how far right that is, so an entry is
written anew for each shift; few shifts are not asked for again.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TYPE_CHECKING, Final, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator, Sequence

# How many units of code stand somewhere: so many lines below the entry before, over so many lines more, from a column
# to another one; these are -1 where none are known.
_Entry: TypeAlias = tuple[int, int, int, int, int]
_ENTRY: Final = re.compile(rb"[\x80-\xff][\0-\x7f]*")
_NO_COLUMNS: Final = 13
_LONG: Final = 14
_NOWHERE: Final = 15
_ONE_LINE: Final = 10
_MOST: Final = 64  # ways to write an entry that are kept
_FIRST: Final = 0x80
_MORE: Final = 0x40
_BITS: Final = 6
_SHORT_COLUMNS, _SHORT_WIDTH, _COLUMNS, _LINES = 80, 16, 128, 3


class LineTable:
    """The table of a code, whose columns move with the texts before them."""

    def __init__(
        self, table: bytes, first: int, lines: Collection[int], moved_by: Callable[[int, int], int]
    ) -> None:
        """Take the table of a code apart that begins at a line; columns move on some `lines`.

        `moved_by` says for a line and a column of it the number of the shift that it has, 0 for none.
        """
        self._pieces: list[bytes] = []  # what stays and what moves in turn
        self._begins, self._ends = list[int](), list[int]()
        self._entries: list[_Entry] = []
        self._ways: list[dict[tuple[int, int], bytes]] = []  # the same for those that are the same
        self._last: tuple[Sequence[int], bytes] | None = None
        ways: dict[_Entry, dict[tuple[int, int], bytes]] = {}
        line, fixed = first, list[bytes]()
        for written in _ENTRY.findall(table):
            if line not in lines and (written[0] >> 3) & 15 < _ONE_LINE:  # of a line that does not move
                fixed.append(written)
                continue
            entry = _entry(written)
            _, down, over, column, end = entry
            line += down
            if column < 0 or (line not in lines and line + over not in lines):
                fixed.append(written)
                continue
            begin, behind = moved_by(line, column), moved_by(line + over, end)
            if begin == behind == 0:
                fixed.append(written)
                continue
            self._pieces += (b"".join(fixed), written)
            self._begins.append(begin)
            self._ends.append(behind)
            self._entries.append(entry)
            self._ways.append(ways.setdefault(entry, {}))
            fixed.clear()
        self._pieces.append(b"".join(fixed))

    def moved(self, shifts: Sequence[int]) -> bytes:
        """Return the table with its columns moved by the shifts of those numbers."""
        if self._last is not None and self._last[0] == shifts:
            return self._last[1]
        by = list(
            zip(map(shifts.__getitem__, self._begins), map(shifts.__getitem__, self._ends), strict=True)
        )
        found = list(map(dict.get, self._ways, by))
        if None in found:
            found = list(map(_known, self._ways, self._entries, by))
        pieces = self._pieces.copy()
        pieces[1::2] = found  # type: ignore[assignment] # none is None
        self._last = shifts, b"".join(pieces)
        return self._last[1]


def _known(ways: dict[tuple[int, int], bytes], entry: _Entry, shift: tuple[int, int]) -> bytes:
    written = ways.get(shift)
    if written is None:
        if len(ways) >= _MOST:
            ways.clear()
        written = ways[shift] = _written(entry, *shift)
    return written


@lru_cache(maxsize=1024)  # of a table that repeats itself most are the same
def _entry(written: bytes) -> _Entry:
    kind, count = (written[0] >> 3) & 15, (written[0] & 7) + 1
    if kind < _ONE_LINE:
        column = (kind << 3) | (written[1] >> 4)
        return count, 0, 0, column, column + (written[1] & 15)
    if kind < _NO_COLUMNS:
        return count, kind - _ONE_LINE, 0, written[1], written[2]
    if kind == _NOWHERE:
        return count, 0, 0, -1, -1
    numbers = list(_numbers(written[1:]))
    down = -(numbers[0] >> 1) if numbers[0] & 1 else numbers[0] >> 1
    if kind == _NO_COLUMNS:
        return count, down, 0, -1, -1
    _, over, column, end = numbers
    return count, down, over, column - 1, end - 1


def _numbers(written: bytes) -> Iterator[int]:
    number = place = 0
    for byte in written:
        number |= (byte & (_MORE - 1)) << place
        place += _BITS
        if not byte & _MORE:
            yield number
            number = place = 0


def _written(entry: _Entry, at_begin: int, at_end: int) -> bytes:
    """Return the bytes of an entry whose columns have moved, as the compiler writes them."""
    count, down, over, column, end = entry
    count, column, end = count - 1, column + at_begin, end + at_end
    if over == 0:
        if down == 0 and column < _SHORT_COLUMNS and 0 <= end - column < _SHORT_WIDTH:
            return bytes((_FIRST | (column >> 3) << 3 | count, (column & 7) << 4 | (end - column)))
        if 0 <= down < _LINES and column < _COLUMNS and end < _COLUMNS:
            return bytes((_FIRST | (_ONE_LINE + down) << 3 | count, column, end))
    signed = down << 1 if down >= 0 else -down << 1 | 1
    numbers = b"".join(map(_number, (signed, over, column + 1, end + 1)))
    return bytes((_FIRST | _LONG << 3 | count,)) + numbers


def _number(number: int) -> bytes:
    found = bytearray()
    while number >= _MORE:
        found.append(_MORE | (number & (_MORE - 1)))
        number >>= _BITS
    return bytes((*found, number))
