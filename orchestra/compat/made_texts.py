"""Texts that code puts together: which part of one is wrong, and what should stand in place of that part."""

from __future__ import annotations

import ast
import os
import re
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.compat.literals import Literal
    from orchestra.location import Span

_SHORT: Final = 2  # letters, which may stand anywhere
_TOLD: Final = re.compile(r"'([^']+)'|(\S*/[^\s:,]+)")
_WITH_BLANKS: Final = re.compile(r"()([^:,']+)")


def part_of(found: Literal, meant: str, message: str) -> tuple[Span, str] | None:
    """Return where the one text stands that is wrong in what an expression has made, and what should stand there.

    All that is made by the rest of it, as `'left'` of `side + ' cam'`, is part of what was meant, too. None where no
    text is such, or several are, and where the expression is no more than a text.
    """
    if found.node is None or isinstance(found.node, ast.Constant) or "$(" in meant:
        return None
    made = _made(meant, message)
    if meant.startswith("/") and not made.startswith("/"):
        made = os.path.abspath(made)  # noqa: PTH100 - pathlib is slow
    elif not meant.startswith("/"):
        made = made.removeprefix("/")
    parts = list(_parts(found.texts, made, meant))
    if len(parts) > 1:  # a slash between two of them is that of the second
        parts = [part for part in parts if part[1].startswith("/")]
    return parts[0] if len(parts) == 1 else None


def _made(meant: str, message: str) -> str:
    """Return the text that a message tells of; a path in a folder with blanks in its name begins as what was meant."""
    first, blank, _ = meant.partition(" ")
    begin = message.find(first + blank) if blank and first.startswith("/") else -1
    told = (_TOLD if begin < 0 else _WITH_BLANKS).search(message, max(begin, 0))
    return "" if told is None else told[1] or told[2]


def _parts(texts: dict[str, Span], made: str, meant: str) -> Iterator[tuple[Span, str]]:
    for text, span in texts.items():
        if not text:  # it is in any text
            continue
        begin, is_there, end = made.partition(text)
        kept = len(begin) + len(end)
        # Where nothing is kept, the text that is told may be any other that stands there.
        fits = is_there and meant.startswith(begin) and meant.endswith(end) and len(meant) > kept > 0
        is_short = len(text) <= _SHORT and text.isalnum()
        if fits and not is_short and meant[len(begin) : len(meant) - len(end)] != text:
            yield span, meant[len(begin) : len(meant) - len(end)]
