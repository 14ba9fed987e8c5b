"""Plain texts that are numbers, or booleans, but for a slip: YAML reads a text, which nobody means.

A comma, brackets that lack, a comment without its blank, two letters in each other's place.
"""

from __future__ import annotations

from typing import Final

from orchestra.patterns import pattern
from orchestra.resolve.rcl.scalars import SLIPS

_NUMBER: Final = r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
_ENDED: Final = pattern(rf"({_NUMBER}|true|True|false|False)[,;]|(true|True|false|False)\.")
_DECIMAL: Final = pattern(r"[-+]?(?:0,[0-9]+|[0-9]+,(?:[0-9]{1,2}|[0-9]{4,}))(?:[eE][-+]?[0-9]+)?")
_COMMENTED: Final = pattern(rf"({_NUMBER}|true|True|false|False)(?:#+\s?|\s+//\s*)(\S.*)")
_SUFFIXED: Final = pattern(r"([-+]?[0-9]*\.[0-9]+)[fFdD]")  # as in C
_POINTED: Final = pattern(
    r"[-+]?[1-9][0-9]{0,2}(?:\.[0-9]{3})?\.000\.000|[-+]?[1-9][0-9]{0,2}\.[0-9]{3}\.000"
)
_BOOLEANS: Final = ("true", "false")
_SEVERAL: Final = pattern(rf"(\()?({_NUMBER}(?:\s*,\s*{_NUMBER})+),?(?(1)\))")


# A number with a point, and a letter that looks like a digit.
_LETTERED: Final = pattern(r"[-+]?(?=[0-9OoIl.]*[0-9])(?=[0-9.]*[OoIl])[0-9OoIl]+\.[0-9OoIl]+")
_DIGITS: Final = str.maketrans("OoIl", "0011")


def without_slip(text: str) -> tuple[str, str] | None:
    """Return what a text lacks or has too much to be what it looks like, and how that is written; None for any other.

    Whole numbers with commas between them, as `640,480`, may well be a text that a program takes apart.
    """
    if ended := _ENDED.fullmatch(text):
        return f"the '{text[-1]}' belongs to it, and ends nothing here", ended[1] or ended[2]
    if commented := _COMMENTED.fullmatch(text):
        return "a comment begins with a blank and '#'", f"{commented[1]} # {commented[2]}"
    if meant := SLIPS.get(text.lower()) or (text.lower() if text.lower() in _BOOLEANS else None):
        return f"the boolean is {meant}", meant.capitalize() if text.istitle() else meant
    if suffixed := _SUFFIXED.fullmatch(text):
        return "a number has no letter behind it", suffixed[1]
    if _DECIMAL.fullmatch(text):
        return "a number is written with a point", text.replace(",", ".")
    return _with_points(text) if "." in text else None


def _with_points(text: str) -> tuple[str, str] | None:
    if _POINTED.fullmatch(text):
        return "a number has no points between its thousands", text.replace(".", "")
    if _LETTERED.fullmatch(text):
        return "a letter stands among its digits", text.translate(_DIGITS)
    several = _SEVERAL.fullmatch(text)
    return None if several is None else ("a list stands in [ ]", f"[{several[2]}]")
