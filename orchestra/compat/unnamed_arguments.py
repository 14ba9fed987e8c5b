"""An argument without a name behind one with a name: CPython tells of the bracket at the end of the call."""

from __future__ import annotations

import re
from itertools import pairwise
from typing import Final

from orchestra.compat.scanned import CLOSING, signs

_NAMED: Final = re.compile(r"\s*(?:\w+\s*=(?!=)|\*\*)")


def unnamed_argument(source: str, offset: int) -> tuple[int, int] | None:
    """Return from where to where the first such argument of the call around an offset stands."""
    opened: list[int] = []
    commas: dict[int, list[int]] = {}
    for sign in signs(source):
        if sign.text == "," and sign.around:
            commas.setdefault(sign.around[-1], []).append(sign.offset)
        elif sign.text in CLOSING.values() and sign.around and sign.offset >= offset:
            opened = [sign.around[-1], sign.offset]
            break
    if not opened:
        return None
    places = [opened[0], *commas.get(opened[0], ()), opened[1]]
    is_behind = False
    for begin, end in pairwise(places):
        text = source[begin + 1 : end]
        if _NAMED.match(text):
            is_behind = True
        elif is_behind and text.strip() and not text.lstrip().startswith("*"):
            first = begin + 1 + len(text) - len(text.lstrip())
            return first, first + len(text.strip())
    return None
