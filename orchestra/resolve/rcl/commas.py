"""Plain texts that are numbers but for a comma or the brackets: YAML reads a text, which nobody means."""

from __future__ import annotations

from typing import Final

from orchestra.patterns import pattern

_NUMBER: Final = r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
_ENDED: Final = pattern(rf"({_NUMBER}|true|True|false|False)[,;]")
_DECIMAL: Final = pattern(r"[-+]?(?:0,[0-9]+|[0-9]+,(?:[0-9]{1,2}|[0-9]{4,}))")
_SEVERAL: Final = pattern(rf"{_NUMBER}(?:\s*,\s*{_NUMBER})+,?")


def without_comma(text: str) -> tuple[str, str] | None:
    """Return what a text lacks or has too much to be what it looks like, and how that is written; None for any other.

    Whole numbers with commas between them, as `640,480`, may well be a text that a program takes apart.
    """
    if ended := _ENDED.fullmatch(text):
        return f"the '{text[-1]}' belongs to it, and ends nothing here", ended[1]
    if _DECIMAL.fullmatch(text):
        return "a number is written with a point", text.replace(",", ".")
    if "." in text and _SEVERAL.fullmatch(text):
        return "a list stands in [ ]", f"[{text.rstrip(',')}]"
    return None
