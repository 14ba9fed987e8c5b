"""The table of a code that says where its instructions stand, for a text in which repetitions were left out."""

from __future__ import annotations

import sys
from operator import sub
from typing import TYPE_CHECKING, Final, NamedTuple, TypeAlias

from orchestra.resolve.python.line_tables import NOWHERE, Place, placed, places_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from types import CodeType

    from orchestra.resolve.python.run_texts import Run

_JOINS: Final = sys.version_info >= (3, 12)  # what stands at one place has one entry
# Entries of a repetition that are known, and the line of the last one; or units and place of the next ones, and
# whether these stand around all repetitions.
_Piece: TypeAlias = "tuple[bytes, int] | tuple[int, Place, bool]"


class Entry(NamedTuple):
    """Units of an instruction, the number of its constant that differs, its place, and whether that stays."""

    units: int
    slot: int | None
    place: Place
    stays: bool


def moved(entries: Iterable[tuple[bytes, int, Place]], run: Run, end: int) -> Iterator[bytes]:
    """Yield the entries of a table for the whole text; what ends from a line on ends further down."""
    before = shift = 0
    for entry, count, place in entries:
        if place is NOWHERE:
            yield entry
            continue
        there = _moved(place, run, end)
        by = there.line - place.line
        if by == shift and there.last - place.last == by:
            yield entry
        else:
            yield placed(count, there, before + shift)
        before, shift = place.line, by


def _moved(place: Place, run: Run, end: int) -> Place:
    by = run.moved if place.line >= run.line else 0
    return Place(
        place.line + by, place.last + (run.moved if place.last >= end else 0), place.column, place.end
    )


class Pattern:
    """How a repetition is written in the table, by the widths of its literals."""

    def __init__(
        self, entries: list[Entry], literals: Sequence[tuple[int, int]], widths: list[int], run: Run
    ) -> None:
        """Take the entries of a repetition, and the literals that differ in it: lines, columns and widths.

        Raises `ValueError` where a line is in two repetitions.
        """
        self._entries = entries
        self._widths = widths
        self._end = run.line + run.lines
        self._run = run
        own = [entry.place for entry in entries if not entry.stays]
        if max(max(place[:2]) for place in own) - min(min(place[:2]) for place in own) >= run.lines:
            raise ValueError("a line is in two repetitions")
        if _JOINS and entries[0].place == entries[-1].place:
            raise ValueError("two repetitions have one entry")
        self._before = [
            [
                [number for number, at in enumerate(literals) if at[0] == line and at[1] < column]
                for line, column in ((place.line, place.column), (place.last, place.end))
            ]
            for _, _, place, _ in entries
        ]
        self._known: dict[tuple[tuple[int, ...], tuple[int, ...]], list[_Piece]] = {}

    def places(self, widths: Sequence[int]) -> list[Place]:
        """Return the places with literals of other widths."""
        by = list(map(sub, widths, self._widths))
        return [
            place
            if stays
            else place._replace(
                column=place.column + sum(by[number] for number in before),
                end=place.end + sum(by[number] for number in behind),
            )
            for (_, _, place, stays), (before, behind) in zip(self._entries, self._before, strict=True)
        ]

    def pieces(self, sizes: tuple[int, ...], widths: tuple[int, ...]) -> list[_Piece]:
        """Return what is written for constants whose instructions have these bytes, and literals of these widths."""
        known = self._known.get((sizes, widths))
        if known is None:
            known = self._known[sizes, widths] = list(self._pieces(sizes, self.places(widths)))
        return known

    def _pieces(self, sizes: tuple[int, ...], places: list[Place]) -> Iterator[_Piece]:
        found: list[tuple[int, Place, bool]] = []
        for entry, place in zip(self._entries, places, strict=True):
            units = entry.units if entry.slot is None else sizes[entry.slot] >> 1
            if _JOINS and found and found[-1][1] == place:
                found[-1] = found[-1][0] + units, place, entry.stays
            else:
                found.append((units, place, entry.stays))
        written, line = b"", -1
        for units, place, stays in found:
            if line >= 0 and not stays:
                written += placed(units, place, line)
                line = place.line
                continue
            if written:
                yield written, line
            written, line = b"", -1 if stays else place.line
            yield units, _moved(place, self._run, self._end) if stays else place, stays
        if written:
            yield written, line


class Table:
    """The table of a code as it is written."""

    def __init__(self, code: CodeType, units: int, line: int, run: Run) -> None:
        """Begin with the entries of so many units of a code, the last one of which is on a line."""
        self._run = run
        self._end = run.line + run.lines
        self._found: list[bytes] = []
        self._line = line
        self._last: tuple[int, Place] | None = None
        kept = []
        for entry in places_of(code.co_linetable, code.co_firstlineno):
            if units <= 0:
                break
            kept.append(entry)
            units -= entry[1]
        if units:
            raise ValueError("an entry is for more than a repetition")
        self._found += moved(kept, run, self._end)

    def repeat(self, pattern: Pattern, times: int, sizes: tuple[int, ...], widths: tuple[int, ...]) -> None:
        """Add a repetition, so many times further down."""
        down, line = times * self._run.lines, self._line
        for piece in pattern.pieces(sizes, widths):
            if len(piece) == 2:  # noqa: PLR2004 - as the pieces are
                self._found.append(piece[0])
                line = piece[1] + down
                continue
            units, place, stays = piece
            if not stays:
                place = Place(place.line + down, place.last + down, place.column, place.end)
            self._found.append(placed(units, place, line))
            line = place.line
        self._line = line

    def add(self, units: int, place: Place) -> None:
        """Add an instruction behind the repetitions, with the place that it has in the shorter text."""
        if place is not NOWHERE:
            place = _moved(place, self._run, self._run.line)
        if self._last is not None and _JOINS and self._last[1] == place:
            self._last = self._last[0] + units, place
            return
        self._flush()
        self._last = units, place

    def _flush(self) -> None:
        if self._last is not None:
            units, place = self._last
            self._found.append(placed(units, place, self._line))
            if place is not NOWHERE:
                self._line = place.line
            self._last = None

    def written(self) -> bytes:
        """Return what is written."""
        self._flush()
        return b"".join(self._found)
