"""Texts that are no numbers, and the numbers that were meant by them."""

from __future__ import annotations

import math
import re
from typing import Final

from orchestra.patterns import pattern

_WITH_UNIT: Final = pattern(
    r"([0-9]+(?:\.[0-9]*)?|\.[0-9]+)\s*(ms|msec|millisec\w*|s|secs?|seconds?|mins?|minutes?|h|hours?)",
    re.IGNORECASE,
)
_UNITS: Final = {"mi": 60.0, "ms": 0.001, "h": 3600.0, "ho": 3600.0}
_WORDS: Final = (
    *("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"),
    *("eleven", "twelve", "thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen", "nineteen"),
)
_TENS: Final = {"twenty": "20", "thirty": "30", "sixty": "60", "hundred": "100"}
_LOOK_ALIKE: Final = str.maketrans({"O": "0", "o": "0", "l": "1", "I": "1"})
_DIGITS_AND_ALIKE: Final = pattern(r"[-+]?[0-9OolI]*\.?[0-9OolI]+")
_NUMBER: Final = pattern(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)")


def seconds_meant(text: str) -> str | None:
    """Return the number of seconds that is meant by a text, with a unit, a comma for a point, or in a word."""
    pointed = _plain(text)
    found = _WITH_UNIT.fullmatch(pointed)
    if found is not None:
        unit = found[2].lower()
        factor = 0.001 if unit.startswith("mil") else _UNITS.get(unit[:2], 1.0)
        seconds = f"{float(found[1]) * factor:g}"
        return f"{seconds}.0" if seconds.isdigit() else seconds
    near = _number(pointed)
    return near if near is not None and not near.startswith("-") else None


def whole_meant(text: str) -> str | None:
    """Return the whole number that is meant by a text, with a fraction of nothing or in a word."""
    near = _number(_plain(text))
    if near is None or not math.isfinite(float(near)) or float(near) % 1:
        return None
    return str(int(float(near)))


def _plain(text: str) -> str:
    """Return a text without quotes and signs of other languages around it, with a point for a comma."""
    bare = text.strip().strip("\"'").rstrip(",;").rstrip()
    return re.sub(r"(?<=[0-9]),(?=[0-9])", ".", bare, count=1)


def _number(text: str) -> str | None:
    """Return the number that a text stands for, None where that is not plain."""
    word = text.lower()
    if word in _WORDS:
        return str(_WORDS.index(word))
    if word in _TENS:
        return _TENS[word]
    bare = re.sub(r"(?<=[0-9])[fF]\Z", "", re.sub(r"\.\.+", ".", text))
    if not _NUMBER.fullmatch(bare) and any(map(str.isdigit, bare)) and _DIGITS_AND_ALIKE.fullmatch(bare):
        bare = bare.translate(_LOOK_ALIKE)
    return bare if _NUMBER.fullmatch(bare) else None
