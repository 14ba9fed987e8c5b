"""An XML file laid out: two blanks per level, attributes on one line where they fit, comments where they were.

An element with text in it is taken over as it stands: blanks may mean something there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.formatting.lines import Line, Tail, joined, shifted
from orchestra.formatting.xml_tree import Element, Part, Piece, parsed

if TYPE_CHECKING:
    from collections.abc import Sequence

_STEP = 2
_ATTRIBUTES = 4  # further in than what is inside of the element
_VERBATIM = ("text", "data")


def xml_formatted(text: str, width: int) -> str:
    """Return a well-formed XML text in its one form. Raises `NotFormatted` for what has none."""
    layout = _Layout(text, width)
    layout.parts(parsed(text), 0, 0)
    return joined(layout.lines)


@dataclass(slots=True)
class _Layout:
    """Lays out one file."""

    text: str
    width: int
    lines: list[Line] = field(default_factory=list)

    def parts(self, parts: Sequence[Part], begin: int, indent: int) -> None:
        """Add what is in an element; what is before it ends at an offset."""
        last = begin
        for index, part in enumerate(parts):
            between = self.text[last : part.start]
            if isinstance(part, Piece) and self.is_tail(part, between, indent, first=index == 0):
                self.tail(part)
            else:
                if index and between.count("\n") > 1:
                    self.lines.append(Line(""))
                self.part(part, indent)
            last = part.end

    def part(self, part: Part, indent: int) -> None:
        if isinstance(part, Element):
            self.element(part, indent)
            return
        first, *rest = self.text[part.start : part.end].split("\n")
        moved = shifted(rest, indent - self.column(part.start)) if part.kind == "comment" else rest
        self.lines.extend(Line(line.rstrip()) for line in (" " * indent + first, *moved))

    def element(self, element: Element, indent: int) -> None:
        """Add an element."""
        if _is_verbatim(element):
            tag = self.tag(element, ">", indent)
            inside = self.text[element.inside : element.end].split("\n")
            self.lines.extend(map(Line, [*tag[:-1], tag[-1] + inside[0], *inside[1:]]))
        elif not element.content:
            self.lines.extend(map(Line, self.tag(element, "/>", indent)))
        else:
            self.lines.extend(map(Line, self.tag(element, ">", indent)))
            self.parts(element.content, element.inside, indent + _STEP)
            self.lines.append(Line(f"{' ' * indent}</{element.name}>"))

    def tag(self, element: Element, end: str, indent: int) -> list[str]:
        """Return the lines of a start tag."""
        margin = " " * indent
        attributes = [f"{name}={_quoted(value)}" for name, value in element.attributes]
        line = f"{margin}<{' '.join([element.name, *attributes])}{end}"
        if "\n" not in line and (len(line) <= self.width or len(attributes) <= 1):
            return [line]
        *others, last = [f"{margin}{' ' * _ATTRIBUTES}{attribute}" for attribute in attributes]
        return "\n".join([f"{margin}<{element.name}", *others, last + end]).split("\n")

    def is_tail(self, part: Piece, between: str, indent: int, *, first: bool) -> bool:
        """Tell whether a part is a comment that stands behind something, and nothing behind it."""
        if part.kind != "comment" or "\n" in between or (first and not indent):
            return False
        behind = self.text[part.end :].partition("\n")[0]
        return not behind.strip() and "\n" not in self.text[part.start : part.end]

    def tail(self, part: Piece) -> None:
        line_start = self.text.rfind("\n", 0, part.start) + 1
        lead = self.text[line_start : part.start].expandtabs()
        self.lines[-1].tail = Tail(self.text[part.start : part.end], len(lead), len(lead.rstrip()))

    def column(self, offset: int) -> int:
        return len(self.text[self.text.rfind("\n", 0, offset) + 1 : offset].expandtabs())


def _is_verbatim(element: Element) -> bool:
    """Tell whether blanks inside of an element may mean something."""
    kept = any(isinstance(part, Piece) and part.kind in _VERBATIM for part in element.content)
    return kept or ("xml:space", '"preserve"') in element.attributes


def _quoted(value: str) -> str:
    """Return an attribute's value in double quotes, unless it has such in it."""
    inner = value[1:-1]
    return value if '"' in inner else f'"{inner}"'
