"""The brackets and commas of Python code that may be none, without what is in texts and comments."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass

if TYPE_CHECKING:
    from collections.abc import Iterator

CLOSING: Final = {"(": ")", "[": "]", "{": "}"}
_TOKEN: Final = re.compile(
    r"""(?P<comment>\#[^\n]*)|(?P<text>'{3}.*?'{3}|"{3}.*?"{3}|'(?:\\.|[^'\\\n])*'|"(?:\\.|[^"\\\n])*")"""
    r"""|(?P<sign>[()\[\]{},\n])""",
    re.DOTALL,
)


@dataclass(frozen=True)
class Sign:
    """A bracket, a comma or the end of a line, at an offset; `around` are the offsets of the brackets that are open."""

    text: str
    offset: int
    around: tuple[int, ...]


def signs(source: str) -> Iterator[Sign]:
    """Yield the signs of some code; a bracket that closes none of its kind ends them, told as it is."""
    opened: list[int] = []
    for found in _TOKEN.finditer(source):
        sign = found["sign"]
        if sign is None:
            continue
        if sign in CLOSING:
            yield Sign(sign, found.start(), tuple(opened))
            opened.append(found.start())
            continue
        yield Sign(sign, found.start(), tuple(opened))
        if sign in CLOSING.values():
            if not opened or CLOSING[source[opened[-1]]] != sign:
                return
            opened.pop()
