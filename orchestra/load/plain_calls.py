"""The shape of texts with nothing but literal text and plain calls, `$(name argument ...)`: nearly all there are.

Two expressions tell it, in a tenth of the time that `grammar` takes to read on character by character; and so they do
for one call of one argument in quotes, as expressions mostly are: `$(eval "'$(var mode)' == 'sim'")`. What has other
quotes, backslashes, nested calls or blanks too many is left to that, and so is whatever may be wrong.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.description.substitutions import SIGNATURES, Part, Shape
from orchestra.patterns import pattern

if TYPE_CHECKING:
    import re


_NAME = r"\$\(([A-Za-z][A-Za-z0-9_-]*)"
_WORD = r"""[^$\\'" ()]+"""
_CALL = rf"{_NAME}((?: {_WORD})*)\)"
_PIECE = pattern(rf"""[^$\\'"]+|{_CALL}""")
_PIECE_IN_QUOTES = pattern(rf"[^$\\]+|{_CALL}")
_ARGUMENT = pattern(_WORD)
_QUOTING = pattern(rf"""{_NAME} (?:"([^\\"]*)"|'([^\\']*)')\)""")

# Substitutions without their '$', of names that nobody puts in brackets for anything else, or with their name before
# the bracket, as `$env(HOME)`.
BARE = pattern(
    r"(?<![$\\\w])(?:(?:\$[ ]|[%@&#])?\((var|find-pkg-share|find-pkg-prefix|exec-in-pkg|find-exec|path-join)[ ]"
    r"(?:[^()]|\$\([^()]*\))+\)"
    r"|\$(env|var|find-pkg-share|find-pkg-prefix|exec-in-pkg|find-exec|dirname|eval|command)\("
    r"((?:[^()]|\$\([^()]*\))*)\))"
)


def plain_shape(text: str) -> Shape | None:
    """Return the shape of a text, None where it takes a closer look."""
    parts = _parts(text, _PIECE, 0, len(text))
    if parts is None:
        parts = _quoting(text)
    return None if parts is None else Shape(parts, text, 0, len(text), False)


def _parts(text: str, pieces: re.Pattern[str], at: int, last: int) -> tuple[Part, ...] | None:
    parts = []
    for piece in pieces.finditer(text, at, last):
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
    return tuple(parts) if at == last else None


def _quoting(text: str) -> tuple[Part, ...] | None:
    """Return the one call with one argument in quotes that a text is; else None."""
    call = _QUOTING.fullmatch(text)
    signature = None if call is None else SIGNATURES.get(call[1])
    if call is None or signature is None or signature.minimum > 1 or signature.maximum == 0:
        return None
    begin, end = call.span(2 if call[3] is None else 3)
    inner = _parts(text, _PIECE_IN_QUOTES, begin, end)
    if inner is None:
        return None
    return (Part(call[1], (Shape(inner, text[begin:end], begin, end, True),), 0, len(text)),)


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
