"""Texts that stand in many places are read once: what is where in a text does not depend on the file.

A file of many nodes has the same few texts in it time and again.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.description.text import Call, Words, new_call, new_template, new_words
from orchestra.errors import Problems
from orchestra.location import Span

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.description.text import Part, Template

    Parse: TypeAlias = Callable[[str, Callable[[int, int], Span], Problems], Template]

# Longer texts are not kept.
_SHORT: Final = 300


def known_template(text: str, parse: Parse) -> Template | None:
    """Return the template of a text, spans as columns; None where there is something to tell of it."""
    return _known(text, parse) if len(text) <= _SHORT else None


@lru_cache(maxsize=1024)
def _known(text: str, parse: Parse) -> Template | None:
    found = Problems()
    template = parse(text, _columns, found)
    return None if len(found) else template


def _columns(first: int, last: int) -> Span:
    return Span("", 1, first, 1, last)


def placed(template: Template, spans: Callable[[int, int], Span], *, quoted: bool) -> Template:
    """Return a template with its spans in a file; it has offsets in the text for columns, and no opaque parts."""
    at = template.span
    parts = tuple([_placed(part, spans) for part in template.parts])
    return new_template(parts, template.raw, spans(at.column, at.end_column), quoted)


def _placed(part: Part, spans: Callable[[int, int], Span]) -> Part:
    at = part.span
    span = spans(at.column, at.end_column)
    if isinstance(part, Words):
        return new_words(part.text, span)
    assert isinstance(part, Call)  # noqa: S101 - the third kind is made by code of others
    arguments = tuple([placed(item, spans, quoted=item.quoted) for item in part.arguments])
    return new_call(part.name, arguments, span)
