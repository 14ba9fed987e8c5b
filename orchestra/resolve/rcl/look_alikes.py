"""Texts that look like a number to who reads them, and are none to rcl: for their characters, a slip, a product."""

from __future__ import annotations

from typing import Final
from unicodedata import normalize

from orchestra.resolve.rcl.commas import without_slip
from orchestra.resolve.rcl.computed import computed
from orchestra.resolve.rcl.scalars import typed

_DASHES: Final = dict.fromkeys(map(ord, "\u2010\u2011\u2012\u2013\u2014\u2212"), "-")


def look_alike(text: str) -> str | None:
    """Return the number or boolean that a text looks like: with a dash as its minus, with wide digits.

    None for any other text.
    """
    if text.isascii():
        return None
    plain = normalize("NFKC", text.translate(_DASHES)).strip()
    return None if plain == text or isinstance(typed(plain), str) else plain


def number_meant(text: str) -> str | None:
    """Return the number that a text is meant to be, None for one that may well be a text."""
    if text.isascii():
        slip = without_slip(text)
        meant = slip[1] if slip is not None else computed(text)
    else:
        meant = look_alike(text)
    return meant if meant is not None and type(typed(meant)) in (int, float) else None
