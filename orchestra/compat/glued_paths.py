"""Paths whose parts are joined without the slash between them: `share + 'launch/a.launch.py'`."""

from __future__ import annotations

import ast
import os
import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator


def without_slash(node: ast.expr | None, message: str) -> tuple[ast.expr, str] | None:
    """Return the part of a path that lacks the slash before it, and with it, where what is missing is there then."""
    for part in _later(node):
        match part:
            case ast.Constant(value=str(text)) if text and not text.startswith("/"):
                found = re.search(rf"\S+(?={re.escape(text)})", message)
                if found is not None and any(os.path.exists(f"{folder}/{text}") for folder in _ends(found)):  # noqa: PTH110 - pathlib is slow
                    return part, f"/{text}"
    return None


def _ends(found: re.Match[str]) -> Iterator[str]:
    """Yield the last word of what ends where this does, the last two, and so on: names of folders may have blanks."""
    words = found.string[: found.end()].split(" ")
    return (" ".join(words[begin:]) for begin in reversed(range(len(words))))


def _later(node: ast.expr | None) -> Iterator[ast.expr]:
    match node:
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            yield from _later(left)
            yield right
        case ast.List(elts=[_, *parts]) | ast.Tuple(elts=[_, *parts]):
            yield from parts
