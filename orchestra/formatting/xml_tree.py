"""XML as written: elements, comments and texts with their places. The text is known to be well formed."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.formatting.refusal import NotFormatted

if TYPE_CHECKING:
    from collections.abc import Iterator

_PIECE = re.compile(
    r"""(?P<comment><!--.*?-->)
    |(?P<data><!\[CDATA\[.*?\]\]>)
    |(?P<other><\?.*?\?>|<!DOCTYPE[^>\[]*>)
    |(?P<close></[^>]*>)
    |<(?P<open>[^\s/>]+)(?P<attributes>(?:\s+[^\s=]+\s*=\s*(?:"[^"]*"|'[^']*'))*)\s*(?P<empty>/?)>
    |(?P<text>[^<]+)""",
    re.DOTALL | re.VERBOSE,
)
_ATTRIBUTE = re.compile(r"""\s+([^\s=]+)\s*=\s*("[^"]*"|'[^']*')""")


@dataclass(frozen=True, slots=True)
class Piece:
    """A comment, a text, a section of character data, or what the parser is told: its kind and its place."""

    kind: str
    start: int
    end: int


@dataclass(slots=True)
class Element:
    """An element: its attributes as written, quotes included, what is in it, and where that begins."""

    name: str
    attributes: tuple[tuple[str, str], ...]
    start: int
    inside: int
    end: int = 0
    content: list[Part] = field(default_factory=list)


Part: TypeAlias = Element | Piece


def parsed(text: str) -> list[Part]:
    """Return the parts of a well-formed text, blanks between them left out. Raises `NotFormatted`."""
    root = Element("", (), 0, 0)
    opened = [root]
    for found in _pieces(text):
        if found["open"] is not None:
            attributes = tuple(_ATTRIBUTE.findall(found["attributes"]))
            element = Element(found["open"], attributes, found.start(), found.end(), found.end())
            opened[-1].content.append(element)
            if not found["empty"]:
                opened.append(element)
        elif found["close"] is not None:
            opened.pop().end = found.end()
        elif found["text"] is None or found["text"].strip():
            opened[-1].content.append(Piece(str(found.lastgroup), found.start(), found.end()))
    return root.content


def _pieces(text: str) -> Iterator[re.Match[str]]:
    at = 0
    while at < len(text):
        found = _PIECE.match(text, at)
        if found is None:
            raise NotFormatted(f"what stands at offset {at} has no form here")
        yield found
        at = found.end()
