"""Lists whose items have several types, which no parameter can hold: which item is the odd one, and what was meant."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Final

from orchestra.nearest import nearest
from orchestra.patterns import pattern
from orchestra.resolve.rcl.scalars import typed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.values import Scalar

_FEWEST: Final = 3  # of two items either may be the odd one: it is the second
_WHOLE: Final = pattern(r"[-+]?(?:0|[1-9][0-9]*)")
_POINTED: Final = pattern(r"([-+]?(?:0|[1-9][0-9]*))\.0*")
_NUMBERS: Final = pattern(
    r"{0}(?:\s+{0})+".format(r"[-+]?(?:[0-9]+(?:\.[0-9]+)?|\.[0-9]+)")
)  # without commas
_BOOLEANS: Final = ("true", "false")
_TYPES: Final = (bool, int, float)


def odd_item(values: Sequence[Scalar]) -> int | None:
    """Return the position of the item that is of another type than the others, None where all are of one.

    It is the only one of its type, else the first that is of another type than the first of all. Among integers and
    floats it is an integer where a float has a fraction, and a float is never the odd one for being the first.
    """
    kinds = [type(value) for value in values]
    counts = Counter(kinds)
    if str in counts and len(counts) > 1 and counts[str] <= len(kinds) - counts[str]:
        meant = (at for at, value in enumerate(values) if isinstance(value, str) and _number_meant(value))
        if (odd := next(meant, None)) is not None:
            return odd
    if set(counts) == {int, float} and any(value % 1 for value in values if isinstance(value, float)):
        return kinds.index(int)
    differing = next((index for index, kind in enumerate(kinds) if kind is not kinds[0]), None)
    if differing is None or len(kinds) < _FEWEST or len(counts) > 2:  # noqa: PLR2004 - two types
        return differing
    single = [kind for kind, count in counts.items() if count == 1]
    if not single or (set(counts) == {int, float} and single[0] is float):
        return differing
    return kinds.index(single[0])


def _number_meant(text: str) -> str | None:
    """See `number_meant`, which only lists of several types need."""
    from orchestra.resolve.rcl.look_alikes import number_meant  # noqa: PLC0415

    return number_meant(text)


def wanted_type(values: Sequence[Scalar], odd: int) -> type:
    """Return the type that the odd item should have: that of most others, of those that are not of its own."""
    own = type(values[odd])
    return Counter(type(value) for value in values if type(value) is not own).most_common(1)[0][0]


def in_place(text: str, wanted: type, *, quoted: bool, quote: str = '"') -> str | None:
    """Return how an item is written with another type, None where it has no such reading.

    `text` is its text without quotes; a text is put in `quote`.
    """
    value = text if quoted else typed(text)
    if wanted is str:
        return f"{quote}{text}{quote}" if quote not in text and "\\" not in text else None
    if quoted:
        return text if wanted in _TYPES and type(typed(text)) is wanted else None
    if wanted is bool:
        return _boolean(text, value)
    if wanted in (int, float) and type(value) is str and _NUMBERS.fullmatch(text):
        return ", ".join(text.split())
    if wanted in (int, float) and type(value) is str:
        meant = _number_meant(text)
        return meant if meant is not None and type(typed(meant)) is wanted else None
    if wanted is float:
        return f"{text}.0" if type(value) is int and _WHOLE.fullmatch(text) else None
    pointed = _POINTED.fullmatch(text) if wanted is int else None
    return pointed[1] if pointed is not None else None


def _boolean(text: str, value: Scalar) -> str | None:
    if type(value) is int and value in (0, 1):
        return str(bool(value)).lower()
    return nearest(text, _BOOLEANS) if isinstance(value, str) else None
