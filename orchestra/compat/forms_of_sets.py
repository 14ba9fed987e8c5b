"""Code of a dictionary, a pair or a list, made of code of a set: a comma stands there in place of a colon."""

from __future__ import annotations

import ast

_TWO = 2


def with_colon(source: str) -> str | None:
    """Return a set of two things as the dictionary of one."""
    items = _items(source)
    return f"{{{items[0]}: {items[1]}}}" if len(items) == _TWO else None


def as_pair(source: str) -> str | None:
    """Return a set of two things as the pair of them, and so the dictionary of one."""
    items = _items(source)
    return f"({items[0]}, {items[1]})" if len(items) == _TWO else None


def as_list(source: str) -> str | None:
    """Return a set as a list."""
    items = _items(source)
    return f"[{', '.join(items)}]" if items else None


def _items(source: str) -> list[str]:
    """Return the code of the items of a set, or of the only name and its value in a dictionary."""
    try:
        node = ast.parse(source, mode="eval").body
    except SyntaxError:
        return []
    match node:
        case ast.Set(elts=items):
            return [ast.unparse(item) for item in items]
        case ast.Dict(keys=[ast.expr() as name], values=[value]):
            return [ast.unparse(name), ast.unparse(value)]
    return []
