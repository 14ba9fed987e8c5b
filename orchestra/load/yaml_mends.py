"""What may have been meant where a text is no YAML."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final

from orchestra.description.actions import ACTIONS
from orchestra.load import yaml_plain
from orchestra.load.conflicts import TOLD, settled
from orchestra.load.mended import Mend
from orchestra.load.yaml_escapes import escaped
from orchestra.load.yaml_file import EXPANDED, tree_of
from orchestra.location import offsets_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.load.faults import RefusedError
    from orchestra.load.offsets import Source
    from orchestra.load.reader import Reader

_BROKEN: Final = re.compile(r"[\r\n]")
_COMMENT: Final = re.compile(r"(?<!\s)\s+#.*$")  # blanks are gone through once, from the first of them
_CLOSERS: Final = {"[": "]", "{": "}"}
_AGAIN: Final = re.compile(r"---.*\n(?:launch:.*)?")
_ITEM: Final = re.compile(r"( *)- (?:" + "|".join(map(re.escape, ACTIONS)) + r")\s*:")
_TABS: Final = re.compile(r"( *\t[ \t]*)")
_NAME: Final = re.compile(r"[\w./~*-]+")


def tree(whole: Source, reader: Reader) -> Any:  # noqa: ANN401 - a tree
    """Return the tree of a YAML text. Raises `RefusedError`."""
    found = yaml_plain.read(whole)
    return tree_of(whole, reader) if found is None else found


def mends(error: RefusedError, whole: Source) -> Iterator[Mend]:
    """Yield what may have been meant, the likeliest first; what is no suggestion puts a whole action in doubt."""
    place = offsets_of(error.fault.span)
    if place is None or error.fault.message == EXPANDED:
        return
    if whole.text.startswith("\\", place[0]) and error.fault.suggestion is not None:
        yield Mend(tuple(escaped(whole.text, place[0])))
    elif error.fault.suggestion is not None:
        yield Mend(((*place, error.fault.suggestion),))
    for mend in _guesses(error, whole.text, *place):
        begin, end = mend.doubted or place
        around = _around(whole.text, begin)
        yield Mend(mend.edits, (min(begin, around[0]), max(end, around[1])))


def _guesses(error: RefusedError, text: str, begin: int, end: int) -> Iterator[Mend]:
    written = text[begin:end]
    if TOLD in error.fault.message:
        yield from settled(text, begin)
    elif written in ("'", '"'):
        yield from _quoted(text, begin)
    elif written in _CLOSERS:
        yield from _closed(text, begin, error.at)
    elif written == "\t":
        yield from _without_tabs(text, begin)
    elif written == "---" and (again := _AGAIN.match(text, begin)) is not None:
        yield Mend(((begin, again.end(), ""),), again.span())
    elif written == "-":
        yield Mend(((begin, begin + 2, ""),))
    elif written in ("]", "}", ","):
        yield Mend(((begin, end, " "),), (begin, end))
    else:
        yield Mend(((begin, begin, ", "),), (begin, end))
        name = _NAME.match(text, begin)
        if name is not None and not text.startswith(":", name.end()):
            yield Mend(((name.end(), name.end(), ":"),), (begin, end))
    yield from _indented(text, begin)
    for at in dict.fromkeys((begin, error.at)):
        yield from _left_out(text, at)


def _around(text: str, at: int) -> tuple[int, int]:
    """Return the range of the action that a place is in, or of its line."""
    begin, end = text.rfind("\n", 0, at) + 1, _line_end(text, at)
    own = _indent(text[begin:end].replace("\t", ""))
    first = begin
    while not _ITEM.match(text, first) and first > 0:
        first = text.rfind("\n", 0, first - 1) + 1
    found = _ITEM.match(text, first)
    if found is None or len(found[1]) > own:
        return begin, end
    while end < len(text):
        following = _line_end(text, end + 1)
        line = text[end + 1 : following]
        if line.strip() and _indent(line) <= len(found[1]):
            break
        end = following
    return first, end


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip(" "))


def _without_tabs(text: str, at: int) -> Iterator[Mend]:
    """Take the tabs before lines for so many blanks, as far as each line has one."""
    tabs, line = list[tuple[int, int]](), text.rfind("\n", 0, at) + 1
    while (found := _TABS.match(text, line)) is not None:
        tabs.append(found.span(1))
        line = (text.find("\n", line) + 1) or len(text)
    for width in (4, 2, 8):
        yield Mend(tuple((begin, end, text[begin:end].replace("\t", " " * width)) for begin, end in tabs))


def _quoted(text: str, begin: int) -> Iterator[Mend]:
    """Close a text in quotes: at the end of its line, before its comment, or before the next item in brackets."""
    quote, end = text[begin], _line_end(text, begin)
    bare = end - len(_COMMENT.sub("", text[begin:end]))
    for at in dict.fromkeys((begin + end - bare if bare < end else end, end)):
        yield Mend(((at, at, quote),), (begin, end))
    for found in re.finditer(r"[,\]}]", text[begin:end]):
        at = begin + found.start()
        yield Mend(((at, at, quote),), (begin, end))
    yield Mend(((begin, begin + 1, " "),), (begin, end))


def _closed(text: str, begin: int, at: int) -> Iterator[Mend]:
    """Close a bracket: at the end of its line, or of the line before the one where nothing fits any more."""
    closer, end = _CLOSERS[text[begin]], _line_end(text, begin)
    rest = _COMMENT.sub("", text[begin:end]).rstrip().rstrip(",")
    places = [begin + len(rest)]
    before = text[:at].rstrip().rstrip(",")
    if len(before) > begin:
        places.append(len(before))
    for place in places:
        yield Mend(((place, place, closer),), (begin, end))


def _indented(text: str, at: int) -> Iterator[Mend]:
    """Indent a line as one of those around it, or as what stands in the one above."""
    begin, end = text.rfind("\n", 0, at) + 1, _line_end(text, at)
    line = text[begin:end]
    own = len(line) - len(line.lstrip(" \t"))
    above = [item for item in _BROKEN.split(text[:begin]) if item.strip()][-4:]
    below = [item for item in _BROKEN.split(text[end:]) if item.strip()][:2]
    widths = []
    for item in (*below, *reversed(above)):
        width = _indent(item)
        inner = len(item) - len(item.lstrip(" -"))
        widths += [inner, width, width + 2, inner + 2]
    for width in dict.fromkeys(widths):
        if width != own or "\t" in line[:own]:
            yield Mend(((begin, begin + own, " " * width),), (begin, end))


def _left_out(text: str, at: int) -> Iterator[Mend]:
    """Leave out the line that is wrong, then what stands below it, too."""
    begin, end = text.rfind("\n", 0, at) + 1, _line_end(text, at)
    yield Mend(((begin, end, ""),), (begin, end))
    line = text[begin:end]
    own = _indent(line)
    while end < len(text):
        following = _line_end(text, end + 1)
        inner = text[end + 1 : following]
        if inner.strip() and _indent(inner) <= own:
            break
        end = following
    yield Mend(((begin, end, ""),), (begin, end))


def _line_end(text: str, begin: int) -> int:
    found = _BROKEN.search(text, begin)
    return len(text) if found is None else found.start()
