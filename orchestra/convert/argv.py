"""Words of a command: a text that a shell would split, as a list of words, and the other way round."""

from __future__ import annotations

import re
from shlex import quote
from typing import TYPE_CHECKING, Any

from orchestra.convert.remarks import UnsayableError
from orchestra.description.text import Template, Words

if TYPE_CHECKING:
    from collections.abc import Iterable

# Stand for substitutions while a text is split: one character each, which no shell takes for anything else.
_FIRST = 0xF0000
_PIECE = re.compile(
    r"(?P<blank>[ \t\r\n]+)|(?P<plain>[^ \t\r\n'\"\\]+)|'(?P<single>[^']*)'"
    r'|"(?P<double>[^"\\]*(?:\\.[^"\\]*)*)"|\\(?P<escaped>.)',
    re.DOTALL,
)
_ESCAPED = re.compile(r'\\(["\\])')
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
        words = split(text) or [""]
    except ValueError as error:
        raise UnsayableError(f"this is no command: {error}", argv.span) from None
    return tuple(_template(word, signs, argv) for word in words)


def split(text: str) -> list[str]:
    """Return the words of a text as `shlex.split` does, which takes time in the square of a word's length.

    Raises `ValueError` where a quote is not closed, or nothing follows a backslash.
    """
    words: list[str] = []
    pieces: list[str] | None = None
    at = 0
    while at < len(text):
        found = _PIECE.match(text, at)
        if found is None:
            raise ValueError("No escaped character" if text[at] == "\\" else "No closing quotation")
        at = found.end()
        if found["blank"]:
            words += [] if pieces is None else ["".join(pieces)]
            pieces = None
            continue
        pieces = [] if pieces is None else pieces
        double = found["double"]
        plain = found["single"] or found["escaped"] or found["plain"] or ""
        pieces.append(plain if double is None else _ESCAPED.sub(r"\1", double))
    return [*words, "".join(pieces)] if pieces is not None else words


def joined(words: Iterable[Template], around: Template) -> Template:
    """Return words as one text; its raw text is left empty for others to write."""
    signs: list[Any] = []
    quoted = []
    for word in words:
        text = "".join(_sign(part, signs) for part in word.parts)
        quoted.append(text if _SAFE.fullmatch(text) else quote(text))
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
