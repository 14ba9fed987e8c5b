"""The actions of a YAML launch file, each by itself.

An item of a list in block form ends where the next one begins, behind its indentation, as lists in it do. The text of
each, with the indentation of both, is read as a document of its own, which is complete if the item is: what is left
open, as a quote or a bracket, is a fault there.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final

from orchestra.load.alike.learned import Forms, Item, Manner, UnlikeError
from orchestra.load.alike.yaml_entities import read

if TYPE_CHECKING:
    from orchestra.description.entity import Action
    from orchestra.load.offsets import Source
    from orchestra.load.reader import Reader

# What a comment may hold here (more characters take 10 ms to be compiled), what stands behind a value up to the next
# one, and lines without any.
_COMMENT: Final = r"#[\t -~\xa0-\xff]*"
_REST: Final = rf"(?: +{_COMMENT}| *)(?:\n *(?:{_COMMENT})?)*"
_EMPTY: Final = rf"(?: *(?:{_COMMENT})?\n)*"
_HEAD: Final = re.compile(rf"{_EMPTY}(?:--- *\n{_EMPTY})?launch: *(?: {_COMMENT})?\n{_EMPTY}(?=( *)- )")
_CLOSED: Final = re.compile(rf"((?:[ ,]*[\]}}])*)({_REST})")
_BEGINNING: Final = re.compile(r"[^\n:]*:")
_WORDS: Final = re.compile(r"(?<![\w-])[\w-]+(?=:[ \n])|[{\[]|\n *- ")

# Values in quotes that have no escapes; plain ones, within a flow collection and outside of one, which mean no null and
# have a colon only where one has been seen. They have few sets of characters, and those few ranges: most of the time
# that it takes to compile a form goes there.
_QUOTED: Final = r"[ !#-&(-[\]-~]+"  # of ASCII all but quotes and backslashes
_BEGUN: Final = r"-{0,2}[\w/.$(+]"
_ENDED: Final = r"(?<! )(?<!ull)(?<!ULL)"
_IN_FLOW: Final = rf"{_BEGUN}[\w $-&(-+\--9;->@-Z^-z|~]*{_ENDED}"
_BLOCK: Final = r"\w$-&(-9;-[\]-~"
_IN_BLOCK: Final = rf"{_BEGUN}[{_BLOCK} ]*{_ENDED}"
_WITH_COLONS: Final = rf"{_BEGUN}[{_BLOCK} ]*(?::[{_BLOCK}][{_BLOCK} ]*)*{_ENDED}"
_QUOTES: Final = ("'", '"')
_BRACKET: Final = re.compile(r"[{\[]")
_DEPTH: Final = 2  # a list that stands behind the key of a mapping

FORMS: Final = Forms()


def items(whole: Source) -> list[Item]:
    """Return the items of the list behind the only key. Raises `UnlikeError` where the file is anything else."""
    text = whole.text
    head = _HEAD.match(text)
    if head is None:
        raise UnlikeError
    begin, following = head.end(), re.compile(rf"\n {{{len(head[1])}}}- ")
    begins = [begin, *(found.start() + 1 for found in following.finditer(text, begin))]
    ends = [begin + len(head[1]) for begin in begins[1:]]
    found = []
    for begin, end in zip(begins, [*ends, len(text)], strict=True):
        beginning = _BEGINNING.match(text, begin, end)
        found.append(Item(begin, end, beginning[0] if beginning is not None else ""))
    return found


def tree(whole: Source, item: Item, reader: Reader) -> Any | None:  # noqa: ANN401 - a tree
    """Return the tree of an item; None where the text does not end with it."""
    from orchestra.load.yaml_plain import read_part  # noqa: PLC0415 - what is read straight needs no parser

    del reader
    listed = read_part(whole, item.begin, item.end, _DEPTH)
    return listed[0] if isinstance(listed, list) and len(listed) == 1 else None


def straight(whole: Source, item: Item, reader: Reader) -> tuple[Action, tuple[str, ...]] | None:
    """Return the action of an item and what tells its form, line by line."""
    return read(whole, item.begin, item.end, reader)


def words(text: str) -> list[str]:
    """Return the keys of an item, and where lists and flow mappings begin."""
    return _WORDS.findall(text)


def _harmless(text: str, start: int, begin: int, end: int) -> str:
    before, behind = text[begin - 1 : begin], text[end : end + 1]
    if before in _QUOTES:
        return _QUOTED if before == behind else ""
    # Behind a bracket fewer characters mean nothing, as long as it is open and, for simplicity, afterwards too.
    if _BRACKET.search(text, start, begin) is not None:
        return _IN_FLOW
    return _WITH_COLONS if text.find(":", begin, end) >= 0 else _IN_BLOCK


def _ending(text: str) -> tuple[str, str]:
    closed = _CLOSED.fullmatch(text)
    return (text, "") if closed is None else (closed[1], _REST)


MANNER: Final = Manner(_harmless, _ending)
