"""Splits a command line by shell rules into words, each of them substitutions.

Quotes may stand around a substitution, whose result is never split: it is read as one character that no text has.
"""

from __future__ import annotations

import re
import shlex
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.frontend.entity import Entity
    from orchestra.compat.launch.substitution import Substitution

_FIRST = 0xF0000  # the first of 65,534 characters that no text has
_MARK = re.compile("([\U000f0000-\U000ffffd])")


def words(entity: Entity, name: str, parser: Any, *, optional: bool = False) -> list[Any] | None:
    """Return the words of an attribute: a command, or a list with one word each; None where it is absent."""
    try:
        text = entity.get_attr(name, optional=optional)
    except TypeError:
        items = entity.get_attr(name, data_type=list[str])
        return [parser.parse_substitution(item) for item in items]
    return None if text is None else parse_cmdline(text, parser)


def parse_cmdline(command: str, parser: Any) -> list[list[Substitution]]:
    """Return the words of a command; an empty one has a single empty word. Raises `ValueError` for an open quote."""
    parts: Sequence[Substitution] = parser.parse_substitution(command)
    text = "".join(
        part.text if isinstance(part, TextSubstitution) else chr(_FIRST + index)
        for index, part in enumerate(parts)
    )
    return [_word(word, parts) for word in shlex.split(text)] or [[TextSubstitution(text="")]]


def _word(word: str, parts: Sequence[Substitution]) -> list[Substitution]:
    pieces = [piece for piece in _MARK.split(word) if piece]
    return [
        parts[ord(piece) - _FIRST] if _MARK.fullmatch(piece) else TextSubstitution(text=piece)
        for piece in pieces
    ] or [TextSubstitution(text="")]
