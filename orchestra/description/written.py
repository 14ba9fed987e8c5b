"""How texts and calls are written in a launch file, so that they are read back unchanged."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TYPE_CHECKING

from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Iterable

_SPECIAL = pattern(r"([\\$])")
_PIECE = pattern(r"\\.|\$\(|.", re.DOTALL)
_IN_ARGUMENT = frozenset("'\"()")
_SIGNS = _IN_ARGUMENT | {" ", "$", "\\"}


def escaped(text: str) -> str:
    """Return how a text is written so that it is read back unchanged, alone or beside other text."""
    return _SPECIAL.sub(r"\\\1", text) if "$" in text or "\\" in text else text


def called(name: str, arguments: Iterable[str]) -> str:
    """Return a substitution as written, from the texts of its arguments as written alone."""
    return _called(name, tuple(arguments))


@lru_cache(maxsize=1024)
def _called(name: str, arguments: tuple[str, ...]) -> str:
    return f"$({' '.join((name, *map(_argument, arguments)))})"


def _argument(text: str) -> str:
    """Return how a text is written as an argument: in quotes where it is empty or has spaces outside of calls.

    A call with quotes of its own cannot stand in quotes: there is no way to write that.
    """
    if text and _SIGNS.isdisjoint(text):  # as nearly always
        return text
    found, spaced, depth = [], not text, 0
    for piece in _PIECE.findall(text):
        spaced |= depth == 0 and " " in piece
        found.append(f"\\{piece}" if depth == 0 and piece in _IN_ARGUMENT else piece)
        depth += (piece == "$(") - (piece == ")" and depth > 0)
    quote = "'" if spaced else ""
    return f"{quote}{''.join(found)}{quote}"
