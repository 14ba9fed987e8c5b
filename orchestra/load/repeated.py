"""Texts that stand in many places are read once: what is where in a text does not depend on the file.

A file of many nodes has the same few texts in it time and again.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.description.substitutions import Part as _Part
from orchestra.description.substitutions import Shape
from orchestra.description.text import Call, Words, new_call, new_template, new_words
from orchestra.errors import Problems
from orchestra.load.plain_calls import plain_shape
from orchestra.location import Span

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.description.text import Part, Template

    # Reads a text by itself.
    Parse: TypeAlias = Callable[[str, Callable[[int, int], Span], Problems], Template]

# Longer texts are not kept.
SHORT: Final = 300


def known_template(text: str, parse: Parse) -> Shape | None:
    """Return what the template of a text looks like; None where there is something to tell of it."""
    return _known(text, parse) if len(text) <= SHORT else None


@lru_cache(maxsize=1024)
def _known(text: str, parse: Parse) -> Shape | None:
    plain = plain_shape(text)
    if plain is not None:
        return plain
    found = Problems()
    template = parse(text, _columns, found)
    return None if len(found) else _shape(template)


def _columns(first: int, last: int) -> Span:
    return Span("", 1, first, 1, last)


def _shape(template: Template) -> Shape:
    at = template.span
    return Shape(tuple(map(_part, template.parts)), template.raw, at.column, at.end_column, template.quoted)


def _part(part: Part) -> _Part:
    at = part.span
    if isinstance(part, Words):
        return _Part(part.text, None, at.column, at.end_column)
    assert isinstance(part, Call)  # noqa: S101 - the third kind is made by code of others
    return _Part(part.name, tuple(map(_shape, part.arguments)), at.column, at.end_column)


def placed(shape: Shape, spans: Callable[[int, int], Span], quoted: bool) -> Template:
    """Return the template of such a shape with its spans in a file."""
    whole = spans(shape.begin, shape.end)
    return new_template(_parts(shape, spans, whole), shape.raw, whole, quoted)


def placed_parts(shape: Shape, spans: Callable[[int, int], Span]) -> tuple[Part, ...]:
    """Return the parts of such a template."""
    return _parts(shape, spans, spans(shape.begin, shape.end))


def _parts(shape: Shape, spans: Callable[[int, int], Span], whole: Span) -> tuple[Part, ...]:
    parts, _, begin, end, _ = shape
    made: list[Part] = []
    for text, arguments, first, last in parts:
        at = whole if first == begin and last == end else spans(first, last)
        if arguments is None:
            made.append(new_words(text, at))
        else:
            inner = [placed(argument, spans, argument.quoted) for argument in arguments]
            made.append(new_call(text, tuple(inner), at))
    return tuple(made)
