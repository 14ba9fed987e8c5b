"""What the code that is written for a form calls: texts, entities and lists, which stand where groups of a match do."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final

from orchestra.description.entity import matched_entity
from orchestra.description.source import Verbatim
from orchestra.description.text import (
    Items,
    PlainCall,
    matched_template,
    matched_words,
    new_template,
    new_words,
    pieces_of,
)
from orchestra.load.grammar import unescaped
from orchestra.load.plain_calls import plain_shape
from orchestra.location import Matched, inside

if TYPE_CHECKING:
    from orchestra.description.text import Piece, Pieces, Template
    from orchestra.load.reader import Reader
    from orchestra.location import Span


def template(text: str, matched: Matched, group: int, quoted: bool, reader: Reader) -> Template:
    """Return a text with substitutions, as `Reader` reads it; the place of the group is that without quotes."""
    if "$" in text or "(" in text or "\\" in text or text[-1:] in _QUOTES:
        pieces = _pieces(text)
        if pieces is None:
            return reader.template(_written(text, matched.span(group), quoted))
        return matched_template(text, quoted, matched, group, pieces)
    return matched_words(text, quoted, matched, group)


def harmless(text: str, matched: Matched, group: int, quoted: bool, reader: Reader) -> Template:
    """Return the same of a text that forms match: there are no quotes and no backslashes in it, and it is not empty."""
    if "$" in text or "(" in text:
        return template(text, matched, group, quoted, reader)
    return matched_words(text, quoted, matched, group)


@lru_cache(maxsize=256)
def _pieces(text: str) -> Pieces | None:
    """Return the pieces of a text of calls and words, None where it takes a closer look."""
    pieces: list[Piece] = []
    for index, piece in enumerate(_CALLS.split(text)):
        if index % 2:
            call = _call(piece)
            if call is None:
                return _nested(text)
            pieces.append(call)
        elif piece:
            if not _UNLIKE.isdisjoint(piece):
                return _nested(text)
            pieces.append(piece)
    return pieces_of(pieces)


def _nested(text: str) -> Pieces | None:
    from orchestra.load.nested import nested  # noqa: PLC0415 - many files have none of them

    return nested(text)


@lru_cache(maxsize=256)  # the calls of a launch file are few, however many different texts they stand in
def _call(text: str) -> PlainCall | None:
    shape = plain_shape(text)
    if shape is None or len(shape.parts) != 1:
        return None
    (call,) = shape.parts
    words = tuple((word.raw, word.begin, word.end) for word in call.arguments or ())
    variable = words[0][0] if call.text == "var" and len(words) == 1 else None
    return PlainCall(call.text, words, len(text), variable)


def literal(text: str, matched: Matched, group: int, quoted: bool, reader: Reader) -> Template:
    """Return a text without substitutions."""
    del reader
    span = _written(text, matched.span(group), quoted).span
    return new_template((new_words(unescaped(text), span),), text, span, quoted)


def items(values: tuple[Template, ...], matched: Matched, group: int) -> Items:
    """Return a list that stands at the place of a group."""
    return Items(values, matched.span(group))


def _written(text: str, at: Span, quoted: bool) -> Verbatim:
    return Verbatim(text, inside(at, -quoted, len(text) + quoted), quoted)


_QUOTES: Final = ("", "'", '"')
_CALLS: Final = re.compile(r"""(\$\([^$\\'"()]+\))""")
_UNLIKE: Final = frozenset("$\\'\"(")
# By the names that the code has for them.
MAKING: Final[dict[str, Any]] = {
    "Matched": Matched,
    "entity": matched_entity,
    "harmless": harmless,
    "items": items,
    "literal": literal,
    "template": template,
}
