"""XML texts as elements with places, by expat.

Expat tells where an element begins and what its attributes are worth, not where they stand: their places are read from
the start tag, which is known to be well formed by then. lxml knows lines alone and has no columns. Document types are
refused, so there are no entities but the five of XML itself: nothing can be expanded without bound or fetched.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING
from xml.parsers import expat

from orchestra.errors import Code
from orchestra.load.elements import Element, new_attribute
from orchestra.load.faults import Fault, RefusedError
from orchestra.load.xml_faults import Opened, explained

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.load.offsets import Source

_DEEPEST = 100
_ATTRIBUTE = re.compile(r"""\s*([^\s=]+)\s*=\s*(["'])(.*?)\2""", re.DOTALL)
_END_OF_TAG = re.compile(r"\s*/?>")
_DOCTYPE = "<!DOCTYPE"


class NotXmlError(RefusedError):
    """The text is no XML, or such that nobody needs it in a launch file.

    `code` is that of expat, `opened` are the elements that were open where it gave up.
    """

    def __init__(self, fault: Fault, code: int = 0, at: int = 0, opened: tuple[Element, ...] = ()) -> None:
        super().__init__(fault, at)
        self.code, self.opened = code, opened


def parse(whole: Source, begin: int = 0, end: int | None = None) -> Element:
    """Return the root element, or the one that stands between two offsets. Raises `NotXmlError`."""
    parser = expat.ParserCreate("utf-8")  # whatever the text declares: it has been decoded
    parser.ordered_attributes = True
    text = whole.text[begin:end]
    content = text.encode("utf-8", "surrogatepass")
    if "\0" in text[:2]:  # expat would take it for UTF-16, whatever it has been told
        code, at = expat.errors.codes[expat.errors.XML_ERROR_INVALID_TOKEN], text.index("\0")
        raise NotXmlError(explained(code, at, whole, None), code, at)
    offset = _offsets(text, content)
    elements = _Elements(whole, (lambda index: begin + offset(index)) if begin else offset, parser)
    elements.deepest -= begin > 0  # it stands in another one
    parser.StartElementHandler = elements.start
    parser.EndElementHandler = elements.end
    parser.CharacterDataHandler = elements.text
    parser.StartDoctypeDeclHandler = elements.doctype
    try:
        parser.Parse(content, True)
    except expat.ExpatError as error:
        at = elements.offset(max(parser.ErrorByteIndex, 0))
        fault = explained(error.code, at, whole, elements.opened())
        raise NotXmlError(fault, error.code, at, tuple(elements.open)) from None
    finally:
        del elements.parser  # they hold each other, and all that has been read
    return elements.roots[0]


def _offsets(text: str, content: bytes) -> Callable[[int], int]:
    """Return a function from indices of bytes, asked in rising order, to those of code points."""
    if len(text) == len(content):
        return lambda index: index
    last = [0, 0]

    def offset(index: int) -> int:
        while content[index : index + 1] and content[index] & 0xC0 == 0x80:  # noqa: PLR2004 - in a character
            index -= 1
        if index < last[0]:
            last[:] = [0, 0]
        last[1] += len(content[last[0] : index].decode("utf-8", "surrogatepass"))
        last[0] = index
        return last[1]

    return offset


class _Elements:
    """Builds elements from what the parser tells."""

    def __init__(self, whole: Source, offset: Callable[[int], int], parser: expat.XMLParserType) -> None:
        self.whole = whole
        self.offset = offset
        self.parser = parser
        self.roots: list[Element] = []
        self.open: list[Element] = []
        self.deepest = _DEEPEST

    def opened(self) -> Opened | None:
        """Return the name and the place of the innermost element that is open."""
        if not self.open:
            return None
        around = tuple(element.name for element in self.open[:-1])
        inner = {
            child.name: self.whole.span(child.end - 2, child.end)
            for child in self.open[-1].children
            if self.whole.text.endswith("/>", 0, child.end)
        }
        return Opened(self.open[-1].name, self.open[-1].span(self.whole), around, inner)

    def start(self, name: str, pairs: list[str]) -> None:
        at = self.offset(self.parser.CurrentByteIndex) + 1
        if len(self.open) >= self.deepest:
            fault = Fault(f"the file nests more than {_DEEPEST} deep", self.whole.span(at, at + len(name)))
            raise NotXmlError(fault)
        element = _element(self.whole.text, name, at, pairs)
        (self.open[-1].children if self.open else self.roots).append(element)
        self.open.append(element)

    def end(self, name: str) -> None:
        del name
        self.open.pop()

    def text(self, data: str) -> None:
        stripped = data.strip()
        if not stripped or self.open[-1].text is not None:
            return
        at = self.offset(self.parser.CurrentByteIndex) + len(data) - len(data.lstrip())
        self.open[-1].text = (at, at + len(stripped))

    def doctype(self, name: str, system: str | None, public: str | None, internal: int) -> None:
        """Refuse a document type that says more than the name of the root."""
        del name
        if system is None and public is None and not internal:
            return
        at = self.whole.text.rfind(_DOCTYPE, 0, self.offset(self.parser.CurrentByteIndex) + len(_DOCTYPE))
        message = (
            "a document type has no place in a launch file: entities are not expanded, nothing is fetched"
        )
        raise NotXmlError(Fault(message, self.whole.span(at, at + len(_DOCTYPE)), Code.SYNTAX))


def _element(text: str, name: str, at: int, pairs: list[str]) -> Element:
    """Return an element without its content; `pairs` are names and values of its attributes in turn."""
    end = at + len(name)
    attributes = []
    for index in range(0, len(pairs), 2):
        found = _ATTRIBUTE.match(text, end)
        assert found is not None  # noqa: S101 - the parser has read the same
        attributes.append(
            new_attribute(pairs[index], pairs[index + 1], found.start(1), found.start(3), found.end(3))
        )
        end = found.end()
    closed = _END_OF_TAG.match(text, end)
    return Element(name, at, closed.end() if closed else end, tuple(attributes))
