"""Texts of Python files that repeat themselves, and shorter ones without most of the repetitions."""

from __future__ import annotations

from collections import Counter
from itertools import islice
from operator import eq, sub
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from orchestra.resolve.python.form_slots import QUOTES, Slots, is_sum, number_of, sum_of

if TYPE_CHECKING:
    from collections.abc import Sequence

_LEAST: Final = 8  # repetitions that a text is looked through for
_BEHIND: Final = 2  # repetitions that are left behind what is left out


class Repeated(NamedTuple):
    """How the text of a file repeats itself: from a literal on, each so many literals later, so many times."""

    begin: int
    period: int
    times: int


def repeated(between: Sequence[str]) -> Repeated | None:
    """Return how what stands between literals repeats itself, from a piece with the end of a line on."""
    counts = Counter(piece for piece in between if "\n" in piece)
    often = [count for count in counts.values() if count >= 2 * _LEAST]
    if not often:
        return None
    rarest = next(piece for piece, count in counts.items() if count == min(often))
    places = [index for index, piece in enumerate(between) if piece == rarest]
    ((period, _),) = Counter(map(sub, places[1:], places)).most_common(1)
    alike = bytes(map(eq, between, islice(between, period, None))) + b"\0"
    middle = places[len(places) // 2]
    start, end = alike.rfind(b"\0", 0, middle) + 1, alike.find(b"\0", middle)
    if end - start < _LEAST * period:
        return None
    begin = next((index for index in range(start, end) if "\n" in between[index]), end)
    return Repeated(begin, period, (end - begin) // period)


class Run:
    """A text that repeats itself, and the one that is compiled for it; lines are those of that one.

    `line` is the first one that is no longer where it was: `moved` lines have been left out before it, those of
    `left_out` repetitions of so many `lines`. `places` are line, column, end and number of the literals just before.
    """

    def __init__(self, parts: list[str], repetitions: Repeated, kept: int) -> None:
        """Leave out all but the first repetitions and a few. Raises `ValueError` where a literal decides something."""
        self._begin, self.period, count = repetitions
        self.left_out = count - kept - _BEHIND
        first = self._begin + kept * self.period
        self._parts = parts[: 2 * first] + parts[2 * (first + self.left_out * self.period) :]
        self._literals = parts[2 * self._begin + 1 : 2 * (self._begin + count * self.period) : 2]
        before = "".join(parts[: 2 * first])
        self.line = before.count("\n") + 2
        self.lines = "".join(parts[2 * (first - self.period) : 2 * first]).count("\n")
        self.moved = self.lines * self.left_out
        self.places = _places(parts[: 2 * first], 2 * self.period)
        self._values: dict[int, list[Any]] = {}
        self._widths: dict[int, list[int]] = {}
        self._check(first - self.period)

    def _check(self, first: int) -> None:
        """Find the literals that differ, of which one repetition begins with the `first`."""
        differing = []
        for number in range(self.period):
            texts = self._literals[number :: self.period]
            if texts.count(texts[0]) < len(texts):
                differing.append(first + number)
                comments = [text[0] == "#" for text in texts]
                if any(comments):
                    if not all(comments):
                        raise ValueError("a comment where there is a literal elsewhere")
                else:
                    self._values[number] = _values(texts)
                    self._widths[number] = list(map(len, texts))
        Slots(self._parts, ()).at(differing)

    @property
    def shorter(self) -> str:
        """The text that is compiled."""
        return "".join(self._parts)

    @property
    def differing(self) -> int:
        """How many literals of a repetition are others in some."""
        return len(self._values)

    def differs(self, literal: int) -> bool:
        """Return whether a literal is another one in some repetition."""
        return (literal - self._begin) % self.period in self._values

    def values(self, literal: int) -> list[Any]:
        """Return the values of a literal in the repetition before its own, its own, and all further ones."""
        return self._from(literal, self._values)

    def widths(self, literal: int) -> list[int]:
        """Return how long a literal is in the same ones."""
        return self._from(literal, self._widths)

    def text(self, literal: int) -> str:
        """Return a literal."""
        return self._parts[2 * literal + 1]

    def _from(self, literal: int, found: dict[int, list[Any]]) -> list[Any]:
        repetition, number = divmod(literal - self._begin, self.period)
        return found[number][repetition - 1 :]


def _places(parts: Sequence[str], literals: int) -> list[tuple[int, int, int, int]]:
    """Return where the last literals of a text are: line, column, end and number."""
    first = len(parts) - 2 * literals
    text = "".join(parts[:first])
    line, column = text.count("\n") + 1, len(text) - text.rfind("\n") - 1
    found = []
    for index in range(first, len(parts)):
        part = parts[index]
        if index & 1:
            found.append((line, column, column + len(part), index >> 1))
        if "\n" in part:
            line, column = line + part.count("\n"), len(part) - part.rfind("\n") - 1
        else:
            column += len(part)
    return found


def _values(texts: list[str]) -> list[Any]:
    """Return the values of literals of one kind. Raises `ValueError` for others, and those that are not plain."""
    sign = texts[0][0]
    if sign in QUOTES:
        values = [text[1:-1] for text in texts]
        written = "".join(values)
        if {text[0] for text in texts} != {sign} or sign in written or "\\" in written or "\n" in written:
            raise ValueError("texts of several kinds")
        return values
    found = list(map(sum_of if is_sum(texts[0]) else number_of, texts))
    if None in found:
        raise ValueError("numbers of several kinds")
    return [number for _, number in found]
