"""What may have been meant where a text is no XML."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final
from xml.parsers.expat import ErrorString, errors

from orchestra.description.actions import ACTIONS, model_of
from orchestra.load.conflicts import TOLD, settled
from orchestra.load.forms import forms_of
from orchestra.load.keys import spelled
from orchestra.load.mended import Mend
from orchestra.load.xml_file import tree_of
from orchestra.load.xml_parser import NotXmlError, parse
from orchestra.location import offsets_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from orchestra.load.elements import Element
    from orchestra.load.faults import RefusedError
    from orchestra.load.offsets import Source
    from orchestra.load.reader import Reader

_ATTRIBUTE: Final = re.compile(r"""\s*=\s*(?:"[^"<]*"|'[^'<]*'|[^\s/>]*)""")
_TAG: Final = re.compile(r"<[^<>]*>")
# Blanks are gone through once, from the first of them.
_NEXT: Final = re.compile(r"""(?<!\s)(?:\s+[\w.:-]+\s*=\s*["']|\s*/?>)""")
_CLOSING: Final = re.compile(r"</[\w.:-]+\s*>\s*\Z")
_CLOSED: Final = re.compile(r"</([\w.:-]+)(\s*>\s*</)([\w.:-]+)\s*>")
_LAUNCH: Final = re.compile(r"<launch\b[^<>]*>")


def tree(whole: Source, reader: Reader) -> Any | None:  # noqa: ANN401 - a tree
    """Return the tree of an XML text, None where it is no launch file. Raises `RefusedError`."""
    return tree_of(parse(whole), whole, reader)


def mends(error: RefusedError, whole: Source) -> Iterator[Mend]:
    """Yield what may have been meant, the likeliest first."""
    place = offsets_of(error.fault.span)
    if not isinstance(error, NotXmlError) or not error.code or place is None:
        return  # it is XML, of which too much is refused
    if error.fault.suggestion is not None:
        yield Mend(((*place, error.fault.suggestion),))
    for mend in _guesses(error, whole.text, *place):
        if mend.doubted is None:
            yield mend
        else:
            begin, end = mend.doubted
            tag = whole.text.rfind("<", 0, begin + 1)
            is_inside = tag >= 0 and ">" not in whole.text[tag:begin]
            yield Mend(mend.edits, (tag if is_inside else begin, end))


def _guesses(error: NotXmlError, text: str, begin: int, end: int) -> Iterator[Mend]:
    conflict = tuple(settled(text, begin)) if error.fault.message == TOLD else ()
    if conflict:
        yield from conflict
        return
    by_reason = _BY_REASON.get(ErrorString(error.code))
    if by_reason is not None:
        yield from by_reason(error, text, begin, end)
    yield from _left_out(error, text)


def _mismatch(error: NotXmlError, text: str, begin: int, end: int) -> Iterator[Mend]:
    opened, tag = error.opened[-1], text.rfind("<", 0, error.at)
    found = _TAG.match(text, tag)
    name = text[tag + 2 : found.end() - 1].strip() if found else ""
    ended = next((child for child in reversed(opened.children) if child.name == name), None)
    if found is not None and ended is not None and text.endswith("/>", 0, ended.end):
        yield Mend(((ended.end - 2, ended.end, ">"),), found.span())  # what follows belongs in it
    if any(element.name == name for element in error.opened):
        yield from _crossed(opened, text, tag)
        yield from _closed(opened, text, tag, (begin, end))
    if found is not None:
        yield Mend(((*found.span(), f"</{opened.name}>"),), found.span())
        yield Mend(((*found.span(), " " * len(found[0])),), found.span())


def _crossed(opened: Element, text: str, tag: int) -> Iterator[Mend]:
    """Let two closing tags that follow each other change places."""
    found = _CLOSED.match(text, tag)
    if found is not None and found[3] == opened.name:
        yield Mend(((*found.span(1), found[3]), (*found.span(3), found[1])), found.span())


def _closed(opened: Element, text: str, otherwise: int, doubted: tuple[int, int]) -> Iterator[Mend]:
    """Close an element: where one begins that stands beside it or cannot stand in it, else before an offset."""
    model = model_of(spelled(opened.name))
    forms = forms_of(model)
    closing, own = f"</{opened.name}>", _column(text, opened)
    for child in opened.children:
        name = spelled(child.name)
        known = name in forms.elements or (forms.holds_actions and name in ACTIONS)
        if _column(text, child) <= own or (model is not None and not known):
            yield Mend(((child.at - 1, child.at - 1, closing),), doubted)
            break
    else:
        yield Mend(((otherwise, otherwise, closing),), doubted)
    if not forms.holds_actions:
        yield Mend(((opened.end, opened.end, closing),), doubted)


def _column(text: str, element: Element) -> int:
    return element.at - text.rfind("\n", 0, element.at)


def _ended(error: NotXmlError, text: str, begin: int, end: int) -> Iterator[Mend]:
    if error.opened:
        yield from _closed(error.opened[-1], text, len(text), (begin, end))


def _second_root(error: NotXmlError, text: str, begin: int, _end: int) -> Iterator[Mend]:
    """Let what stands behind the root stand in it."""
    first = _CLOSING.search(text, 0, error.at)
    again = _LAUNCH.match(text, error.at)
    if first is not None:
        blank = (first.start(), first.end(), " ")
        if again is not None:
            yield Mend((blank, (*again.span(), " ")), again.span())
        if _CLOSING.search(text, error.at) is not None:
            yield Mend((blank,), (begin, begin))
        yield Mend((blank, (len(text), len(text), first[0].strip())), (begin, begin))
    line = len(text) if (following := text.find("<", error.at)) < 0 else following
    yield Mend(((error.at, line, ""),), (begin, line))


def _twice(_error: NotXmlError, text: str, begin: int, end: int) -> Iterator[Mend]:
    """Leave out the second attribute."""
    found = _ATTRIBUTE.match(text, end)
    if found is not None:
        yield Mend(((begin, found.end(), " "),), (begin, found.end()))


def _late_declaration(_error: NotXmlError, text: str, begin: int, _end: int) -> Iterator[Mend]:
    closed = text.find("?>", begin)
    if closed >= 0:
        yield Mend(((begin, closed + 2, ""),))


def _unclosed(_error: NotXmlError, text: str, begin: int, _end: int) -> Iterator[Mend]:
    """Close what is open at the end of its line."""
    line = _line_end(text, begin)
    for closer in ("-->",) if text.startswith("<!--", begin) else ("/>", ">", "?>", '"/>', '">'):
        yield Mend(((line, line, closer),), (begin, line))


def _invalid(error: NotXmlError, text: str, begin: int, end: int) -> Iterator[Mend]:
    """Mend what the parser takes for no token, by what is marked."""
    written = text[begin:end]
    if written in _WRITTEN:
        yield from _WRITTEN[written](error, text, begin, end)
    elif text[begin - 1 : begin] in ("'", '"'):
        yield Mend(((begin, begin, " "),))
    else:
        yield Mend(((begin, end, " " * (end - begin)),), (begin, end))


def _without_dashes(error: NotXmlError, text: str, begin: int, _end: int) -> Iterator[Mend]:
    """Leave out the dashes of a comment."""
    opened, closed = text.rfind("<!--", 0, error.at) + 4, text.find("-->", begin)
    if closed >= 0:
        yield Mend(((opened, closed, text[opened:closed].replace("-", " ")),))


def _unfinished(error: NotXmlError, text: str, begin: int, _end: int) -> Iterator[Mend]:
    """End a tag before the next one."""
    at = len(text[: error.at].rstrip())
    for closer in ("/>", ">"):
        yield Mend(((at, at, closer),), (begin, at))


def _quoted(_error: NotXmlError, text: str, begin: int, _end: int) -> Iterator[Mend]:
    """Close a value: before the next attribute of its line, the end of its tag, or that of the line."""
    line = _line_end(text, begin)
    for found in _NEXT.finditer(text, begin + 1, line):
        yield Mend(((found.start(), found.start(), text[begin]),), (begin, found.end()))
    yield Mend(((line, line, text[begin]),), (begin, line))


def _ends_element(_error: NotXmlError, text: str, begin: int, _end: int) -> Iterator[Mend]:
    """Leave out what stands between the two characters that end an element."""
    yield Mend(((begin, text.find(">", begin), "/"),))


def _left_out(error: NotXmlError, text: str) -> Iterator[Mend]:
    """Leave out the tag that is wrong, or its line."""
    begin = text.rfind("<", 0, error.at + 1)
    found = _TAG.match(text, begin) if begin >= 0 else None
    if found is not None and found.end() > error.at:
        yield Mend(((*found.span(), " "),), found.span())
    begin, end = text.rfind("\n", 0, error.at) + 1, _line_end(text, error.at)
    yield Mend(((begin, end, " " * (end - begin)),), (begin, end))


def _line_end(text: str, begin: int) -> int:
    end = text.find("\n", begin)
    return len(text) if end < 0 else end


_WRITTEN: Final[dict[str, Callable[[NotXmlError, str, int, int], Iterator[Mend]]]] = {
    "--": _without_dashes,
    "<!--": _unclosed,
    "]]>": lambda _error, _text, begin, end: iter([Mend(((begin, end, "]]&gt;"),))]),
    "=": lambda _error, _text, begin, end: iter([Mend(((begin, end, ""),))]),
    "'": _quoted,
    '"': _quoted,
    "<": _unfinished,
    "/": _ends_element,
}
_BY_REASON: Final[dict[str, Callable[[NotXmlError, str, int, int], Iterator[Mend]]]] = {
    errors.XML_ERROR_SYNTAX: _invalid,
    errors.XML_ERROR_INVALID_TOKEN: _invalid,
    errors.XML_ERROR_NO_ELEMENTS: _ended,
    errors.XML_ERROR_UNCLOSED_TOKEN: _unclosed,
    errors.XML_ERROR_TAG_MISMATCH: _mismatch,
    errors.XML_ERROR_DUPLICATE_ATTRIBUTE: _twice,
    errors.XML_ERROR_JUNK_AFTER_DOC_ELEMENT: _second_root,
    errors.XML_ERROR_MISPLACED_XML_PI: _late_declaration,
}
