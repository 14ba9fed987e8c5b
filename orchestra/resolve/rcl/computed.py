"""Plain texts in which a number is to be computed: an angle as files of ROS 1 have it, a product, a part of pi."""

from __future__ import annotations

import math
from typing import Final

from orchestra.patterns import pattern

_NUMBER: Final = r"(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
_DECIMAL: Final = r"(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)"
_ANGLE: Final = pattern(rf"(deg|rad)\(\s*([-+]?{_NUMBER})\s*\)")
_PI: Final = r"(?:(?:math\.|np\.|numpy\.)?[pP][iI]|M_PI)"
_PRODUCT: Final = pattern(rf"([-+]?)\s*((?:{_PI}|{_NUMBER})(?:\s*[*/]\s*(?:{_PI}|{_NUMBER}))*)")
_FACTOR: Final = pattern(rf"([*/]?)\s*({_PI}|{_NUMBER})")
# Two numbers or more that are only divided, as in ratios and versions; one that is divided, once, is a reciprocal.
_RATIO: Final = pattern(rf"{_DECIMAL}(?:\s*/\s*{_DECIMAL})+")
_RECIPROCAL: Final = pattern(rf"1(?:\.0*)?\s*/\s*{_DECIMAL}")
_LONGEST: Final = 40


def computed(text: str) -> str | None:
    """Return the number that a text comes to, None for one that is probably no such: `16/9`, `pi`, `a/b`.

    Whole numbers alone may be a size, a ratio, a date.
    """
    if not _may_be_computed(text):
        return None
    if angle := _ANGLE.fullmatch(text):
        value = float(angle[2])
        return str(math.radians(value) if angle[1] == "deg" else value)
    found = _PRODUCT.fullmatch(text)
    if found is None:
        return None
    factors = _FACTOR.findall(found[2])
    has_pi = any(not factor[:1].isdigit() and factor[:1] != "." for _, factor in factors)
    is_plain = len(factors) == 1 and not has_pi
    if is_plain or text.lower() == "pi" or not (has_pi or "." in text):
        return None
    return _worth(found[1], factors)


def may_be_ratio(text: str) -> bool:
    """Return whether a text may be meant as it is, where no number is asked for: `16.0/9`, `1.2/3`, not `1/30.0`."""
    return _RATIO.fullmatch(text) is not None and _RECIPROCAL.fullmatch(text) is None


def _may_be_computed(text: str) -> bool:
    return len(text) <= _LONGEST and (
        text[:4] in ("deg(", "rad(") or text[-2:].lower() == "pi" or "*" in text or "/" in text
    )


def _worth(sign: str, factors: list[tuple[str, str]]) -> str | None:
    value = -1.0 if sign == "-" else 1.0
    for operator, factor in factors:
        number = float(factor) if factor[:1] in ".0123456789" else math.pi
        if operator == "/" and not number:
            return None
        value = value / number if operator == "/" else value * number
    return str(value)
