"""What code asks of a thing before it uses it: what kind it is, what it has, or by trying."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Final

from orchestra.compat.scopes import decided_by

if TYPE_CHECKING:
    from collections.abc import Iterable

_ASKING: Final = frozenset(
    {"callable", "dir", "getattr", "hasattr", "isinstance", "issubclass", "type", "vars"}
)
_OWN: Final = frozenset({"__class__", "__dict__"})
_TAKEN: Final = frozenset({"AttributeError", "BaseException", "Exception"})


def asks_of(body: Iterable[ast.AST], written: str) -> bool:
    """Return whether code asks what kind an expression is, or what it has: a name, or an attribute of one.

    `isinstance(event, A)`, `type(event) is A`, `match event:`, `if is_exit(event):`, `getattr(event, 'pid', None)`.
    """
    return any(_asks(node, written) for node in body)


def _asks(node: ast.AST, written: str) -> bool:
    match node:
        case ast.Call(func=ast.Name(id=name), args=[first, *_]) if name in _ASKING:
            return _is(first, written)
        case ast.Attribute(value=value, attr=attr) if attr in _OWN:
            return _is(value, written)
        case ast.Match(subject=subject):
            return any(_is(item, written) for item in ast.walk(subject))
    tests = [item for test in decided_by(node) for item in ast.walk(test)]
    calls = [item for item in tests if isinstance(item, ast.Call)]
    given = [item for call in calls for item in (*call.args, *(word.value for word in call.keywords))]
    return any(_is(item, written) for item in given if isinstance(item, ast.Name))


def _is(node: ast.AST, written: str) -> bool:
    return isinstance(node, ast.Name | ast.Attribute) and ast.unparse(node) == written


def tried(body: Iterable[ast.AST]) -> set[int]:
    """Return the parts of code (by `id`) in which an attribute that something has not is dealt with."""
    found: set[int] = set()
    for node in body:
        match node:
            case ast.Try(body=inner, handlers=handlers) if any(_takes(item.type) for item in handlers):
                pass
            case ast.With(items=items, body=inner) if any(_suppresses(item.context_expr) for item in items):
                pass
            case _:
                continue
        found |= {id(item) for part in inner for item in ast.walk(part)}
    return found


def _takes(kind: ast.expr | None) -> bool:
    return kind is None or any(isinstance(item, ast.Name) and item.id in _TAKEN for item in ast.walk(kind))


def _suppresses(given: ast.expr) -> bool:
    return (
        isinstance(given, ast.Call) and "suppress" in ast.unparse(given.func) and any(map(_takes, given.args))
    )
