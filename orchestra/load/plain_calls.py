"""The shape of texts with nothing but literal text and plain calls, `$(name argument ...)`: nearly all there are.

Two expressions tell it, in a tenth of the time that `grammar` takes to read on character by character. What has quotes,
backslashes, nested calls or blanks too many is left to that, and so is whatever may be wrong.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from orchestra.description.substitutions import SIGNATURES
from orchestra.patterns import pattern

if TYPE_CHECKING:
    import re


class Shape(NamedTuple):
    """A template without a place: offsets in the text stand for spans."""

    parts: tuple[Part, ...]
    raw: str
    begin: int
    end: int
    quoted: bool


class Part(NamedTuple):
    """Words, or a call: its name, and its arguments."""

    text: str
    arguments: tuple[Shape, ...] | None
    begin: int
    end: int


_WORD = r"""[^$\\'" ()]+"""
_PIECE = pattern(rf"""[^$\\'"]+|\$\(([A-Za-z][A-Za-z0-9_-]*)((?: {_WORD})*)\)""")
_ARGUMENT = pattern(_WORD)


def plain_shape(text: str) -> Shape | None:
    """Return the shape of a text, None where it takes a closer look."""
    parts = []
    at = 0
    for piece in _PIECE.finditer(text):
        begin, end = piece.span()
        if begin != at:
            return None
        at = end
        if piece[1] is None:
            parts.append(Part(piece[0], None, begin, end))
            continue
        call = _call(piece, text)
        if call is None:
            return None
        parts.append(call)
    return Shape(tuple(parts), text, 0, at, False) if at == len(text) else None


def _call(piece: re.Match[str], text: str) -> Part | None:
    signature = SIGNATURES.get(piece[1])
    if signature is None:
        return None
    arguments = [_argument(word) for word in _ARGUMENT.finditer(text, *piece.span(2))] if piece[2] else []
    most = signature.maximum
    if len(arguments) < signature.minimum or (most is not None and len(arguments) > most):
        return None
    return Part(piece[1], tuple(arguments), piece.start(), piece.end())


def _argument(word: re.Match[str]) -> Shape:
    begin, end = word.span()
    return Shape((Part(word[0], None, begin, end),), word[0], begin, end, False)
