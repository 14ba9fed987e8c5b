"""Texts with calls in arguments of calls, or in quotes, as conditions are: what they are made of is found out once.

Texts that differ by numbers alone have the same skeleton, in which a 0 stands for each: the grammar takes all digits
alike. Where their parts stand is worked out when somebody asks.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final

from orchestra.description.calculated import DIGIT, Calculated
from orchestra.description.text import matched_template
from orchestra.load.grammar import by_itself
from orchestra.load.plain_calls import BARE
from orchestra.load.repeated import SHORT, known_template, placed_parts
from orchestra.location import Matched, stretches, whole_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.description.source import Written
    from orchestra.description.substitutions import Shape
    from orchestra.description.text import Part, Template
    from orchestra.location import Span, Whole

_DIGITS: Final = re.compile(r"[0-9]+")
_QUOTES: Final = ("'", '"')
_TOLD: Final = ("${", "$[")  # as of quotes at the end


class Nested(Calculated):
    """What such a text is made of."""

    __slots__ = ()

    @staticmethod
    def shape_of(skeleton: str) -> Shape | None:
        """Return what a skeleton looks like; None where there may be something to tell of it."""
        return known_shape(skeleton)

    def placed(self, whole: Span) -> tuple[Part, ...]:
        """Return the parts of a text that stands at a place."""
        shape = known_shape(self.text)
        assert shape is not None  # noqa: S101 - as that of its skeleton
        return placed_parts(shape, stretches(whole))


def known_shape(text: str) -> Shape | None:
    """Return what a short text looks like of which there is nothing to tell; None where there is, or may be."""
    return known_template(text, by_itself)


def nested(text: str) -> Nested | None:
    """Return what a text that stands in a file as it is read is made of; None where that takes a closer look."""
    if (
        len(text) > SHORT
        or not text.isascii()
        or text.endswith(_QUOTES)
        or any(map(text.__contains__, _TOLD))
    ):
        return None
    numbers = tuple(_DIGITS.findall(text))
    skeleton = _DIGITS.sub(DIGIT, text) if numbers else text
    return Nested(text, skeleton, numbers) if _is_sound(skeleton) else None


@lru_cache(maxsize=256)
def _is_sound(skeleton: str) -> bool:
    """Return whether there is nothing to tell of a text, in which there is a call."""
    shape = None if BARE.search(skeleton) else known_shape(skeleton)
    return shape is not None and any(part.arguments is not None for part in shape.parts)


class _Spread(Nested):
    """The same of a text whose characters do not stand in the file as they read; `of` is shared by all that read so."""

    __slots__ = ("of", "spans")

    def __init__(self, of: Nested, spans: Callable[[int, int], Span]) -> None:
        self.of = of
        self.spans = spans
        self.text = of.text
        self.skeleton = of.skeleton
        self.numbers = of.numbers

    @property
    def formula(self) -> Any:  # noqa: ANN401 - as above
        """What resolving makes of it."""
        return self.of.formula

    @formula.setter
    def formula(self, made: Any) -> None:  # noqa: ANN401 - as above
        self.of.formula = made

    @property
    def names(self) -> tuple[str, ...] | None:
        """The variables that it reads."""
        return self.of.names

    @names.setter
    def names(self, found: tuple[str, ...] | None) -> None:
        self.of.names = found

    def placed(self, whole: Span) -> tuple[Part, ...]:
        """Return the parts with their places."""
        del whole
        shape = known_shape(self.text)
        assert shape is not None  # noqa: S101 - as above
        return placed_parts(shape, self.spans)


class _Scattered(Matched):
    """The place of such a text, which is worked out when somebody asks."""

    __slots__ = ("_at", "_length", "_within")

    def __init__(self, whole: Whole, within: Callable[[int, int], Span], length: int) -> None:
        self.whole = whole
        self._within = within
        self._length = length
        self._at: Span | None = None

    def span(self, group: int) -> Span:
        """Return the place."""
        del group
        if self._at is None:
            self._at = self._within(0, self._length)
        return self._at


def spread(written: Written) -> Template | None:
    """Return a text whose characters do not stand in the file as they read; None where that takes a closer look."""
    whole, of = whole_of(written.span), _known(written.text)
    if whole is None or of is None:
        return None
    text, spans = written.text, written.spans
    place = _Scattered(whole, spans, len(text))
    return matched_template(text, written.quoted, place, 0, _Spread(of, spans))


_known: Final = lru_cache(maxsize=256)(nested)
