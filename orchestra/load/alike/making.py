"""What the code that is written for a form calls: texts, entities and places, of offsets in a file."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final

from orchestra.description.entity import new_entity
from orchestra.description.source import Verbatim
from orchestra.description.text import Items, new_call, new_template, new_words
from orchestra.load.grammar import unescaped
from orchestra.load.plain_calls import Part as Shaped
from orchestra.load.plain_calls import plain_shape
from orchestra.location import stretch

if TYPE_CHECKING:
    from orchestra.description.text import Call, Part, Template
    from orchestra.load.reader import Reader
    from orchestra.location import Span, Whole


def template(text: str, whole: Whole, at: tuple[int, int], quoted: bool, reader: Reader) -> Template:
    """Return a text with substitutions, as `Reader` reads it; `at` is its place without quotes."""
    if "$" not in text and "(" not in text and "\\" not in text and text[-1:] not in _QUOTES:
        place = stretch(whole, at[0], at[1])
        return new_template((new_words(text, place),), text, place, quoted)
    parts = _parts(text, whole, at[0])
    if parts is None:
        return reader.template(_written(text, whole, at, quoted))
    return new_template(parts, text, stretch(whole, *at), quoted)


def _parts(text: str, whole: Whole, begin: int) -> tuple[Part, ...] | None:
    """Return the parts of a text of plain calls and words that have none of the characters of calls; else None.

    The calls of a launch file are few, however many different texts they stand in.
    """
    parts: list[Part] = []
    at = begin
    for index, piece in enumerate(_CALLS.split(text)):
        if index % 2:
            call = _call(piece)
            if call is None:
                return None
            parts.append(_placed(call, whole, at, len(piece)))
        elif piece:
            if not _UNLIKE.isdisjoint(piece):
                return None
            parts.append(new_words(piece, stretch(whole, at, at + len(piece))))
        at += len(piece)
    return tuple(parts)


@lru_cache(maxsize=256)
def _call(text: str) -> Shaped | None:
    shape = plain_shape(text)
    return None if shape is None or len(shape.parts) != 1 else shape.parts[0]


def _placed(call: Shaped, whole: Whole, at: int, length: int) -> Call:
    """Return a call, whose arguments are words, at an offset."""
    arguments = []
    for word in call.arguments or ():
        inside = stretch(whole, at + word.begin, at + word.end)
        arguments.append(new_template((new_words(word.raw, inside),), word.raw, inside, word.quoted))
    return new_call(call.text, tuple(arguments), stretch(whole, at, at + length))


def literal(text: str, whole: Whole, at: tuple[int, int], quoted: bool, reader: Reader) -> Template:
    """Return a text without substitutions."""
    del reader
    written = _written(text, whole, at, quoted)
    return new_template((new_words(unescaped(text), written.span),), text, written.span, quoted)


def span(whole: Whole, at: tuple[int, int]) -> Span:
    """Return a place."""
    return stretch(whole, *at)


def items(values: tuple[Template, ...], at: Span) -> Items:
    """Return a list that stands at a place."""
    return Items(values, at)


def _written(text: str, whole: Whole, at: tuple[int, int], quoted: bool) -> Verbatim:
    begin, end = at
    return Verbatim(text, stretch(whole, begin - quoted, end + quoted), quoted)


_QUOTES: Final = ("", "'", '"')
_CALLS: Final = re.compile(r"""(\$\([^$\\'"()]+\))""")
_UNLIKE: Final = frozenset("$\\'\"(")
# By the names that the code has for them.
MAKING: Final[dict[str, Any]] = {
    "entity": new_entity,
    "items": items,
    "literal": literal,
    "span": span,
    "template": template,
}
