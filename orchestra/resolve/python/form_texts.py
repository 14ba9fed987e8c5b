"""What stands in the slots of texts that are alike: these are split at quotes, and compared part by part."""

from __future__ import annotations

from itertools import compress
from operator import contains, le
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.resolve.python.form_slots import QUOTES

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

# What stands before a slot, how long that is, and what the slot ends with.
_Piece: TypeAlias = tuple[str, int, str]
_CODING: Final = "coding"  # how a file is written, as a comment may say


class FormText:
    """A text with slots."""

    def __init__(self, parts: Sequence[str], places: Mapping[int, str | None]) -> None:
        """Take a text that was split, with the numbers of what differs in it, and what stands before each of that.

        That is None for comments. Raises `ValueError` where slots are not where they seem to be.
        """
        self._pieces, self._end = _pieces(parts, places)
        self._comments = [number for number, before in enumerate(places.values()) if before is None]
        text = "".join(parts)
        own = _values(text, self._pieces, self._end)
        if own is None:
            raise ValueError("slots are not where they seemed to be")
        self._parted = None if self._comments else _parted(text, self._pieces, own)

    @property
    def fixed(self) -> str:
        """What the texts have in common."""
        return "\n".join(piece for piece, _, _ in self._pieces) + self._end

    def values(self, text: str) -> list[str] | None:
        """Return what stands in the slots of a text but for comments; None where the rest of it is another one."""
        if self._parted is not None:
            return self._parted.values(text)
        found = _values(text, self._pieces, self._end)
        if found is None:
            return None
        for number in reversed(self._comments):
            if _CODING in found[number] or "\n" in found[number]:
                return None
            del found[number]
        return found


class _Parted:
    """A text with slots by its parts between quotes of one kind, each of which holds no slot or one."""

    def __init__(self, quote: str, parts: list[str], slots: Mapping[int, tuple[str, str, str]]) -> None:
        """Take the parts, and by their numbers what is before and behind the slot there, and what it ends with."""
        self._quote, self._count = quote, len(parts)
        self._has_slot = bytes(index in slots for index in range(len(parts)))
        self._has_none = bytes(index not in slots for index in range(len(parts)))
        self._fixed = list(compress(parts, self._has_none))
        self._heads, self._tails, self._stops = map(list, zip(*slots.values(), strict=True))
        heads, tails = list(map(len, self._heads)), list(map(len, self._tails))
        self._least = [head + tail for head, tail in zip(heads, tails, strict=True)]
        self._to_head = [slice(0, head) for head in heads]
        self._to_tail = [slice(-tail, None) if tail else slice(0, 0) for tail in tails]
        self._to_value = [slice(head, -tail or None) for head, tail in zip(heads, tails, strict=True)]

    def values(self, text: str) -> list[str] | None:
        """Return what stands in the slots, as `_values` does."""
        parts = text.split(self._quote)
        if len(parts) != self._count or list(compress(parts, self._has_none)) != self._fixed:
            return None
        held = list(compress(parts, self._has_slot))
        heads, tails = map(str.__getitem__, held, self._to_head), map(str.__getitem__, held, self._to_tail)
        if (
            not all(map(le, self._least, map(len, held)))
            or list(heads) != self._heads
            or list(tails) != self._tails
        ):
            return None
        found = list(map(str.__getitem__, held, self._to_value))
        return None if any(map(contains, found, self._stops)) else found


def _parted(text: str, pieces: Sequence[_Piece], own: Sequence[str]) -> _Parted | None:
    """Return a text by its parts; None where there are several slots in one."""
    stops = [stop for _, _, stop in pieces]
    quote = max(QUOTES, key=stops.count)
    slots: dict[int, tuple[str, str, str]] = {}
    parts = text.split(quote)
    number, begin, at = 0, 0, 0  # of a part, and a place in the text
    for (_, size, stop), value in zip(pieces, own, strict=True):
        at += size
        while at > begin + len(parts[number]):
            begin += len(parts[number]) + 1
            number += 1
        before = at - begin
        if number in slots or before + len(value) > len(parts[number]):
            return None
        slots[number] = parts[number][:before], parts[number][before + len(value) :], stop
        at += len(value)
    return _Parted(quote, parts, slots)


def _values(text: str, pieces: Sequence[_Piece], end: str) -> list[str] | None:
    """Return what stands in the slots of a text; None where the rest of it is another one."""
    found: list[str] = []
    at = 0
    for piece, size, stop in pieces:
        if not text.startswith(piece, at):
            return None
        at += size
        behind = text.find(stop, at)
        if behind < 0:
            return None
        found.append(text[at:behind])
        at = behind
    return found if text[at:] == end else None


def _pieces(parts: Sequence[str], places: Mapping[int, str | None]) -> tuple[list[_Piece], str]:
    """Return what stands before each slot, how long that is, and what the slot ends with; and the end of the text."""
    found: list[_Piece] = []
    fixed = ""
    last = 0
    for index, before in places.items():
        literal = parts[2 * index + 1]
        fixed += "".join(parts[last : 2 * index + 1])
        last = 2 * index + 2
        if before is None:
            piece, stop, fixed = fixed + literal[0], "\n", ""
        elif literal[0] in QUOTES:
            piece, stop, fixed = fixed + literal[0], literal[0], literal[0]
        else:
            piece, stop, fixed = fixed, parts[last][0], ""
        found.append((piece, len(piece), stop))
    return found, fixed + "".join(parts[last:])
