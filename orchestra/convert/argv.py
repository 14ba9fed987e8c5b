"""Words of a command: a text that a shell would split, as a list of words, and the other way round."""

from __future__ import annotations

import re
import shlex
from typing import TYPE_CHECKING, Any

from orchestra.convert.remarks import UnsayableError
from orchestra.description.text import Template, Words

if TYPE_CHECKING:
    from collections.abc import Iterable

# Stand for substitutions while a text is split: one character each, which no shell takes for anything else.
_FIRST = 0xF0000
_SAFE = re.compile(r"[\w@%+=:,./\U000F0000-\U000FFFFD-]+", re.ASCII)


def words_of(argv: Template | tuple[Template, ...]) -> tuple[Template, ...]:
    """Return the words of a command. Raises `UnsayableError` where its quotes make no words.

    An empty text is one empty word (launch, `ExecuteProcess._parse_cmdline`).
    """
    if isinstance(argv, tuple):
        return argv
    signs: list[Any] = []
    text = "".join(_sign(part, signs) for part in argv.parts)
    try:
        words = shlex.split(text) or [""]
    except ValueError as error:
        raise UnsayableError(f"this is no command: {error}", argv.span) from None
    return tuple(_template(word, signs, argv) for word in words)


def joined(words: Iterable[Template], around: Template) -> Template:
    """Return words as one text; its raw text is left empty for others to write."""
    signs: list[Any] = []
    quoted = []
    for word in words:
        text = "".join(_sign(part, signs) for part in word.parts)
        quoted.append(text if _SAFE.fullmatch(text) else shlex.quote(text))
    return _template(" ".join(quoted), signs, around)


def _sign(part: Any, signs: list[Any]) -> str:  # noqa: ANN401 - a part of a description, whatever it is
    if isinstance(part, Words):
        return part.text
    signs.append(part)
    return chr(_FIRST + len(signs) - 1)


def _template(text: str, signs: list[Any], around: Template) -> Template:
    parts: list[Any] = []
    for piece in re.split("([\U000f0000-\U000ffffd])", text):
        if len(piece) == 1 and _FIRST <= ord(piece) < _FIRST + len(signs):
            parts.append(signs[ord(piece) - _FIRST])
        elif piece:
            parts.append(Words(piece, around.span))
    return Template(tuple(parts), "", parts[0].span if parts else around.span)
