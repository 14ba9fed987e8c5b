"""Elements of an XML file with the place of every name and value, before it is known what they mean."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.dataclass import dataclass, maker
from orchestra.description.source import Keyed, Listed, Verbatim, Written
from orchestra.fields import field
from orchestra.location import Span, stretch
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.load.offsets import Source

# What of an attribute's source stands for one character of its value, and is not one itself.
_PIECE = pattern(r"&[^;]*;|\r\n")


@dataclass(frozen=True, slots=True)
class Attribute:
    """An attribute: offsets of its name, and of the source of its value inside the quotes."""

    name: str
    value: str
    at: int
    begin: int
    end: int

    def span(self, whole: Source) -> Span:
        """Return the place of the name."""
        return stretch(whole, self.at, self.at + len(self.name))

    def written(self, whole: Source) -> Written:
        """Return the value with its place in the file."""
        span = stretch(whole, self.begin, self.end)
        if whole.text[self.begin : self.end] == self.value:
            return Verbatim(self.value, span)
        return Written(self.value, span, spans_in(whole, lambda: (self.begin, self.end)))


new_attribute = maker(Attribute)  # a file has thousands


def spans_in(whole: Source, value: Callable[[], tuple[int, int]]) -> Callable[[int, int], Span]:
    """Return what gives the places of parts of a value whose source stands between two offsets."""
    offsets: list[int] = []

    def spans(first: int, last: int) -> Span:
        if not offsets:
            begin, end = value()
            at = begin
            for found in _PIECE.finditer(whole.text, begin, end):
                offsets.extend(range(at, found.start() + 1))
                at = found.end()
            offsets.extend(range(at, end + 1))
        return whole.span(offsets[first], offsets[last])

    return spans


@dataclass(slots=True)
class Element:
    """An element: `at` is the offset of its name, `end` that behind its start tag.

    `text` is the place of the first text in it that is not blank.
    """

    name: str
    at: int
    end: int
    attributes: tuple[Attribute, ...]
    children: list[Element] = field(default_factory=list)
    text: tuple[int, int] | None = None

    def span(self, whole: Source) -> Span:
        """Return the place of the name."""
        return stretch(whole, self.at, self.at + len(self.name))


class Tagged(Keyed):
    """An element as a mapping; `elements` are the keys that are written as elements, all others are attributes."""

    __slots__ = ("element", "elements")

    def __init__(self, span: Span, head: Span, element: Element, elements: frozenset[str]) -> None:
        super().__init__(span, head)
        self.element = element
        self.elements = elements


def emptied(mapping: Keyed) -> Keyed:
    """Return a mapping of the same kind and place without keys."""
    if isinstance(mapping, Tagged):
        return Tagged(mapping.span, mapping.head, mapping.element, mapping.elements)
    return Keyed(mapping.span, mapping.head)


def noun(mapping: Keyed, key: str) -> str:
    """Return how a key is called in the user's format."""
    if not isinstance(mapping, Tagged):
        return f"key '{key}'"
    return f"element <{key}>" if key in mapping.elements else f"attribute '{key}'"


def beginning_of(value: Any, head: Span) -> Span:  # noqa: ANN401 - a tree
    """Return the place to point at for a value; that of its key, which is `head`, where there is nothing to see.

    It is all of a value on one line, else what it begins with: in block form its first key, an element its name.
    """
    if isinstance(value, Tagged):
        return value.head
    if not isinstance(value, Keyed | Listed | Written) or (isinstance(value, Written) and not value.text):
        return head
    span = value.span
    first = min(value.keys_at.values(), default=None) if isinstance(value, Keyed) else None
    if first is not None and (first.line, first.column) == (span.line, span.column):
        return first
    if span.line == span.end_line or isinstance(value, Written):
        return span
    return Span(span.file, span.line, span.column, span.line, span.column + 1)


def place_of(value: Any, head: Span) -> Span:  # noqa: ANN401 - a tree
    """Return the place to point at for a value of the wrong kind: its key, which is `head`, where it is a block below.

    Anything else is pointed at itself.
    """
    begin = beginning_of(value, head)
    below = type(value) in (Keyed, Listed) and begin.line > head.end_line
    return head if below else begin
