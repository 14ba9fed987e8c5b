"""Comments in XML."""

from __future__ import annotations

import re
from textwrap import dedent

from orchestra.convert.comments.found import Comment, Scan
from orchestra.load.offsets import source

_COMMENT = re.compile(r"<!--(.*?)-->", re.DOTALL)
_ROOT = re.compile(r"<[A-Za-z]")


def scan(text: str) -> Scan:
    """Return the comments of a text that is known to be XML: no attribute can have what begins one."""
    whole = source("", text)
    found = []
    for match in _COMMENT.finditer(text):
        line, column = whole.place(match.start())
        behind = text[whole.lines[line - 1] : match.start()].strip()
        lines = _lines(match[1])
        if lines:
            found.append(Comment(lines, line, column, whole.place(match.end())[0], behind))
    bare = _COMMENT.sub(lambda match: re.sub(r"\S", " ", match[0]), text)
    root = _ROOT.search(bare)
    return Scan(tuple(found), whole.place(root.start() if root else 0)[0])


def _lines(text: str) -> tuple[str, ...]:
    first, _, rest = text.partition("\n")
    lines = [first.strip(), *(line.rstrip() for line in dedent(rest).split("\n"))]
    while lines and not lines[0]:
        lines.pop(0)
    while lines and not lines[-1]:
        lines.pop()
    return tuple(lines)
