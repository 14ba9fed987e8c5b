"""What stands in the slots of texts that are alike: one expression takes these apart, then all is compared at once.

Of what stands between slots the expression asks only how long it is, so that it takes no step for each character,
neither to be made nor to match. What it has found is right where a text that is put together of it is the same.
"""

from __future__ import annotations

from itertools import chain
from operator import itemgetter
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from orchestra.load.alike.assembled import AS_LONG, BEFORE, CLOSE, OPEN, assembled
from orchestra.resolve.python.form_slots import QUOTES

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from orchestra.load.alike.assembled import Part

# What stands before a slot, and what the slot ends with.
_Piece: TypeAlias = tuple[str, str]
_CODING: Final = "coding"  # how a file is written, as a comment may say


class FormText:
    """A text with slots, some of which hold the same."""

    def __init__(
        self, parts: Sequence[str], places: Mapping[int, str | None], numbers: Sequence[int]
    ) -> None:
        """Take a text that was split, with the numbers of what differs in it, and what stands before each of that.

        That is None for comments. `numbers` says which value each of these slots has; those of comments come last.
        """
        pieces, end = _pieces(parts, places)
        fixed = [piece for piece, _ in pieces]
        self._whole = [*chain(*zip(fixed, fixed)), end]  # noqa: B905 - with something in place of each value
        self._each = taking(numbers)
        firsts: dict[int, str] = {}
        taken: list[Part] = []
        # Values that end with something else where they stand again, by their numbers.
        self._elsewhere: list[tuple[int, str]] = []
        for number, (piece, stop) in zip(numbers, pieces, strict=True):
            if number in firsts:
                taken += (AS_LONG, piece), (BEFORE, stop)
                if stop != firsts[number]:
                    self._elsewhere.append((number, stop))
            else:
                firsts[number] = stop
                taken += (AS_LONG, piece), (OPEN, ""), (BEFORE, stop), (CLOSE, "")
        self._match = assembled([*taken, (AS_LONG, end)]).fullmatch
        order = list(firsts)
        self._values = taking(list(map(order.index, range(len(order)))))
        self._count = len(order) - list(places.values()).count(None)

    @property
    def fixed(self) -> str:
        """What the texts have in common."""
        return "\n".join(self._whole[::2])

    def values(self, text: str) -> tuple[str, ...] | None:
        """Return the values of a text by their numbers but for comments; None where the rest of it is another one."""
        found = self._match(text)
        if found is None:
            return None
        values = self._values(found.groups())
        whole = self._whole.copy()
        whole[1::2] = self._each(values)
        if "".join(whole) != text or any(stop in values[number] for number, stop in self._elsewhere):
            return None
        if any(_CODING in comment for comment in values[self._count :]):
            return None
        return values[: self._count]


def taking(places: Sequence[int]) -> Callable[[Sequence[Any]], tuple[Any, ...]]:
    """Return what takes the items at some places."""
    if len(places) > 1:
        return itemgetter(*places)
    return lambda held: tuple(map(held.__getitem__, places))


def _pieces(parts: Sequence[str], places: Mapping[int, str | None]) -> tuple[list[_Piece], str]:
    """Return what stands before each slot, and what the slot ends with; and the end of the text."""
    found: list[_Piece] = []
    fixed = ""
    last = 0
    for index, before in places.items():
        literal = parts[2 * index + 1]
        fixed += "".join(parts[last : 2 * index + 1])
        last = 2 * index + 2
        if before is None:
            found.append((fixed + literal[0], "\n"))
            fixed = ""
        elif literal[0] in QUOTES:
            found.append((fixed + literal[0], literal[0]))
            fixed = literal[0]
        else:
            found.append((fixed, parts[last][0]))
            fixed = ""
    return found, fixed + "".join(parts[last:])
