"""The actions of an XML launch file, each by itself: the elements inside of the root."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final

from orchestra.load.alike.learned import UNKNOWN, Forms, Item, Manner, UnlikeError
from orchestra.load.alike.xml_tags import read
from orchestra.load.xml_file import tree_of_action
from orchestra.load.xml_parser import NotXmlError, parse

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.description.entity import Action
    from orchestra.load.offsets import Source
    from orchestra.load.reader import Reader

_BLANK: Final = "[ \t\r\n]"
# Nothing here can be matched in two ways: what has no end would take for ever.
_BETWEEN: Final = rf"{_BLANK}*(?:<!--(?:(?!--)[\t\r\n -~\xa0-\xff])*-->{_BLANK}*)*"
_NAME: Final = "[A-Za-z][A-Za-z0-9._-]*"
_ENCODING: Final = rf"""encoding=(?:"{_NAME}"|'{_NAME}')"""
_DECLARED: Final = rf"""<\?xml version=(?:"1.0"|'1.0')(?: {_ENCODING})? ?\?>"""
_HEAD: Final = re.compile(f"(?:{_DECLARED})?{_BETWEEN}<launch>")
_BEGUN: Final = re.compile(rf"{_BETWEEN}<([A-Za-z][\w-]*)")
_ATTRIBUTE: Final = rf"""{_BLANK}+[\w.:-]+{_BLANK}*={_BLANK}*(?:"[^"<]*"|'[^'<]*')"""
_TAG: Final = re.compile(rf"<([A-Za-z][\w-]*)(?:{_ATTRIBUTE})*{_BLANK}*(/?)>")
_END: Final = re.compile(rf"{_BETWEEN}</launch{_BLANK}*>{_BETWEEN}\Z")
_WORDS: Final = re.compile(r"""(?<![\w.:-])[\w.:-]+(?==["'])|</?[\w-]+""")
# Values of ASCII, of no character that means something to XML, to YAML as the beginning of a list, or to substitutions.
_VALUE: Final = r"[ !#-%(-;=-Z\]-~]+"

FORMS: Final = Forms()


def items(whole: Source) -> Iterator[Item]:
    """Yield the elements inside of the root; whoever reads one tells where it ends.

    Raises `UnlikeError` where that is not plain to see.
    """
    text = whole.text
    head = _HEAD.match(text)
    if head is None:
        raise UnlikeError
    at = head.end()
    while (begun := _BEGUN.match(text, at)) is not None:
        item = Item(begun.start(1) - 1, UNKNOWN, begun[1])
        yield item
        at = item.end
    if _END.match(text, at) is None:
        raise UnlikeError


def _closed(text: str, begin: int) -> int | None:
    """Return where an element ends that begins at an offset; None where there may be another of its name in it."""
    tag = _TAG.match(text, begin)
    if tag is None or tag[2]:
        return None if tag is None else tag.end()
    end = text.find(f"</{tag[1]}>", tag.end())
    if end < 0:
        return None
    inner = text.find(f"<{tag[1]}", tag.end(), end)
    if inner >= 0 and re.search(rf"<{tag[1]}[^\w-]", text[inner:end]) is not None:
        return None
    return end + len(tag[1]) + len("</>")


def tree(whole: Source, item: Item, reader: Reader) -> Any | None:  # noqa: ANN401 - a tree
    """Return the tree of an element."""
    end = item.end or _closed(whole.text, item.begin)
    if end is None:
        return None
    item.end = end
    try:
        element = parse(whole, item.begin, end)
    except NotXmlError:
        return None
    return tree_of_action(element, whole, reader)


def straight(whole: Source, item: Item, reader: Reader) -> tuple[Action, tuple[Any, ...]] | None:
    """Return the action of an element and what tells its form, tag by tag."""
    found = read(whole, item.begin, reader)
    if found is None:
        return None
    item.end = found[2]
    return found[:2]


def words(text: str) -> list[str]:
    """Return the elements and attributes."""
    return _WORDS.findall(text)


def _harmless(text: str, start: int, begin: int, end: int) -> str:
    del text, start, begin, end
    return _VALUE


def _ending(text: str) -> tuple[str, str]:
    return text, ""


MANNER: Final = Manner(_harmless, _ending)
