"""How text is read as a boolean."""

from __future__ import annotations

from typing import Final

_TRUE: Final = frozenset({"1", "true", "yes", "on"})
_FALSE: Final = frozenset({"0", "false", "no", "off"})


def boolean(text: str) -> bool | None:
    """Read `1`, `0` or a YAML 1.1 boolean in any case, spaces around it ignored; None for anything else.

    Upstream reads conditions and boolean substitutions by two rules. This is the union of both, for every place.
    """
    word = text.strip().lower()
    if word in _TRUE:
        return True
    return False if word in _FALSE else None


condition: Final = boolean  # `if` and `unless` read their text by the same rule
