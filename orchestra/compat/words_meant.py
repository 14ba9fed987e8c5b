"""Code of a list of words, made of code of one text with the words of a command line."""

from __future__ import annotations

import ast
import shlex
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

_OF_SHELLS: Final = frozenset("|&;<>()$`*?~\\\n")  # what a shell would do something with
_OPERANDS: Final = (ast.Name, ast.Attribute, ast.Call, ast.Subscript)


def words_meant(source: str, value: str) -> str | None:
    """Return the words of an expression that has come to a text as code of a list; None where a shell is asked for.

    Of a text that is put together, as `'-d ' + path` or `f'-d {path}'`, each word is the code that makes it.
    """
    try:
        node = ast.parse(source, mode="eval").body
    except SyntaxError:
        return None
    if isinstance(node, ast.Constant):
        return _of_text(value)
    if not isinstance(node, ast.BinOp | ast.JoinedStr):
        return f"[{source}]" if " " not in value else _split(node, source)
    pieces = list(_pieces(node))
    texts = "".join(str(piece.value) for piece in pieces if isinstance(piece, ast.Constant))
    if _OF_SHELLS.intersection(texts) or '"' in texts or "'" in texts:
        return None
    if " " in value and " " not in texts:
        return _split(node, source)
    return f"[{', '.join(map(_code, _words(pieces)))}]"


def _of_text(value: str) -> str | None:
    try:
        return None if _OF_SHELLS.intersection(value) else repr(shlex.split(value))
    except ValueError:
        return None


def _split(node: ast.expr, source: str) -> str:
    return f"{source}.split()" if isinstance(node, _OPERANDS) else f"({source}).split()"


def _pieces(node: ast.expr) -> Iterator[ast.expr]:
    """Yield what a text is put together from."""
    match node:
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            yield from _pieces(left)
            yield from _pieces(right)
        case ast.JoinedStr(values=parts):
            yield from parts
        case _:
            yield node


def _words(pieces: list[ast.expr]) -> list[list[ast.expr]]:
    """Return the pieces of each word: blanks in a text are between words."""
    words: list[list[ast.expr]] = [[]]
    for piece in pieces:
        if not isinstance(piece, ast.Constant):
            words[-1].append(piece)
            continue
        begin, *further = str(piece.value).split(" ")
        words[-1].extend([ast.Constant(begin)] if begin else [])
        words.extend([ast.Constant(part)] if part else [] for part in further)
    return [word for word in words if word]


def _code(word: list[ast.expr]) -> str:
    """Return the code of one word, which is an f-string where it has several pieces."""
    if len(word) == 1 and not isinstance(word[0], ast.FormattedValue):
        return ast.unparse(word[0])
    pieces: list[ast.expr] = [
        piece
        if isinstance(piece, ast.Constant | ast.FormattedValue)
        else ast.FormattedValue(value=piece, conversion=-1)
        for piece in word
    ]
    return ast.unparse(ast.JoinedStr(values=pieces))
