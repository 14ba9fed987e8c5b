"""The actions of an XML launch file, each by itself: the elements inside of the root."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final

from orchestra.load.alike.learned import Forms, Manner
from orchestra.load.alike.one_by_one import Item
from orchestra.load.alike.xml_tags import read
from orchestra.load.xml_file import tree_of_action
from orchestra.load.xml_parser import NotXmlError, parse

if TYPE_CHECKING:
    from orchestra.description.entity import Action
    from orchestra.load.offsets import Source
    from orchestra.load.reader import Reader

_BLANK: Final = "[ \t\r\n]"
# Nothing here can be matched in two ways: what has no end would take for ever.
_BETWEEN: Final = rf"{_BLANK}*(?:<!--(?:(?!--)[\t\r\n -~\xa0-\xff])*-->{_BLANK}*)*"
_NAME: Final = "[A-Za-z][A-Za-z0-9._-]*"
_ENCODING: Final = rf"""encoding=(?:"{_NAME}"|'{_NAME}')"""
_DECLARED: Final = rf"""<\?xml version=(?:"1.0"|'1.0')(?: {_ENCODING})? ?\?>"""
_HEAD: Final = re.compile(f"(?:{_DECLARED})?{_BETWEEN}<launch>{_BETWEEN}")
_SPACE: Final = re.compile(_BETWEEN)
_ATTRIBUTE: Final = rf"""{_BLANK}+[\w.:-]+{_BLANK}*={_BLANK}*(?:"[^"<]*"|'[^'<]*')"""
_TAG: Final = re.compile(rf"<([A-Za-z][\w-]*)(?:{_ATTRIBUTE})*{_BLANK}*(/?)>")
_END: Final = re.compile(rf"</launch{_BLANK}*>{_BETWEEN}\Z")
_WORDS: Final = re.compile(r"""(?<![\w.:-])[\w.:-]+(?==["'])|</?[\w-]+""")
# Values of ASCII, of no character that means something to XML, to YAML as the beginning of a list, or to substitutions.
_VALUE: Final = r"[ !#-%(-;=-Z\]-~]+"

FORMS: Final = Forms()


def items(whole: Source) -> list[Item] | None:
    """Return the elements inside of the root; None where that is not plain to see."""
    text = whole.text
    head = _HEAD.match(text)
    at = len(text) if head is None else head.end()
    found = []
    while (tag := _TAG.match(text, at)) is not None:
        end = tag.end() if tag[2] else _closed(text, tag)
        if end is None:
            return None
        found.append(Item(at, end, tag[1]))
        at = _SPACE.match(text, end).end()  # type: ignore[union-attr]  # matches nothing at least
    return found if _END.match(text, at) is not None else None


def _closed(text: str, tag: re.Match[str]) -> int | None:
    """Return where an element ends that begins with a tag; None where there may be another of its name in it."""
    end = text.find(f"</{tag[1]}>", tag.end())
    if end < 0:
        return None
    inner = text.find(f"<{tag[1]}", tag.end(), end)
    if inner >= 0 and re.search(rf"<{tag[1]}[^\w-]", text[inner:end]) is not None:
        return None
    return end + len(tag[1]) + len("</>")


def tree(whole: Source, item: Item, reader: Reader) -> Any | None:  # noqa: ANN401 - a tree
    """Return the tree of an element."""
    try:
        element = parse(whole, item.begin, item.end)
    except NotXmlError:
        return None
    return tree_of_action(element, whole, reader)


def straight(whole: Source, item: Item, reader: Reader) -> tuple[Action, tuple[str, ...]] | None:
    """Return the action of an element and what tells its form, tag by tag."""
    return read(whole, item.begin, item.end, reader)


def words(text: str) -> list[str]:
    """Return the elements and attributes."""
    return _WORDS.findall(text)


def _harmless(text: str, start: int, begin: int, end: int) -> str:
    del text, start, begin, end
    return _VALUE


def _ending(text: str) -> tuple[str, str]:
    return text, ""


MANNER: Final = Manner(_harmless, _ending)
