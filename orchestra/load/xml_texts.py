"""Text between tags, which says nothing in a launch file: as the attribute that it was probably meant to be."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.load.conflicts import TOLD, is_mark

if TYPE_CHECKING:
    from orchestra.load.elements import Element
    from orchestra.load.offsets import Source
    from orchestra.load.reader import Reader

# What stands between the tags of an element without others in it, on one line.
_INSIDE: Final = re.compile(r"""[ \t]*([^<"\r\n]*?)[ \t]*</[^<>\r\n]*>""")
_LONGEST: Final = 200


def tell_text(element: Element, lacking: frozenset[str], whole: Source, reader: Reader) -> None:
    """Tell of the text in an element: an error, at all of the element, where it lacks what the text is probably."""
    assert element.text is not None  # noqa: S101 - asked by the caller
    message = "text between tags is ignored"
    if not lacking:
        begin, end = element.text
        line = whole.text[begin:].partition("\n")[0].rstrip()
        if is_mark(line):
            message, end = TOLD, begin + len(line)
        reader.warning(Code.WRONG_TYPE, message, whole.span(begin, end))
        return
    key = min(lacking)
    told = f'{message}: write it as {key}="..."'
    inside = _INSIDE.match(whole.text, element.end)
    begin = element.at - len("<")
    tag = whole.text[begin : element.end].removesuffix(">").rstrip()
    if inside is None or "\n" in tag or len(tag) + len(inside[1]) > _LONGEST:
        reader.error(Code.WRONG_TYPE, told, whole.span(*element.text))
        return
    instead = f'{tag} {key}="{inside[1]}"/>'
    reader.error(Code.WRONG_TYPE, told, whole.span(begin, inside.end()), suggestion=instead)


def text_in(element: Element, whole: Source) -> str:
    """Return the text in an element on one line, else dots."""
    inside = _INSIDE.match(whole.text, element.end)
    return inside[1] if inside is not None and inside[1] and len(inside[1]) < _LONGEST else "..."
