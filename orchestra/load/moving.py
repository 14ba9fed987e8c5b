"""Templates that have been read, at another place: what stands where in a text does not depend on the file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.description.text import Call, Template, Words

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.description.text import Part
    from orchestra.location import Span


def placed(template: Template, spans: Callable[[int, int], Span], *, quoted: bool) -> Template:
    """Return a template with its spans in a file; it has offsets in the text for columns, and no opaque parts."""
    at = template.span
    parts = tuple([_placed(part, spans) for part in template.parts])
    return Template(parts, template.raw, spans(at.column, at.end_column), quoted)


def _placed(part: Part, spans: Callable[[int, int], Span]) -> Part:
    at = part.span
    span = spans(at.column, at.end_column)
    if isinstance(part, Words):
        return Words(part.text, span)
    assert isinstance(part, Call)  # noqa: S101 - the third kind is made by code of others
    arguments = tuple([placed(item, spans, quoted=item.quoted) for item in part.arguments])
    return Call(part.name, arguments, span)
