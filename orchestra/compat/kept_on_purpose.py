"""Defaults that all calls of a function share on purpose: what is known already, what has been made, what was seen."""

from __future__ import annotations

import ast
import re
from typing import TYPE_CHECKING, Final

from orchestra.compat.scopes import parameters

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.compat.scopes import Function

_NAMED: Final = re.compile(r"_|.*(?:cache|counter|memo|registry|seen|singleton|visited)")


def is_kept_on_purpose(function: Function, name: str, changes: Sequence[ast.AST]) -> bool:
    """Return whether a parameter is meant to have what earlier calls have added to it.

    Its name says so, or each change is made only where the function has looked whether that is there already: what is
    added is what was looked for, or is the same in all calls. What an action is given whole is no such.
    """
    if _NAMED.match(name.lower()):
        return True
    nodes = list(ast.walk(function))
    asked, given = list(_asked(nodes, name)), parameters(function) - {name}
    used = {id(node.value) for node in nodes if isinstance(node, ast.Expr)}
    return not _is_handed_on(nodes, name) and all(
        _is_asked_for(change, asked, given)
        or (isinstance(change, ast.Call) and _is_set_by_default(change) and id(change) not in used)
        for change in changes
    )


def _is_set_by_default(change: ast.Call) -> bool:
    """Return whether a call returns what is there under a name that is not always the same, or adds it."""
    match change:
        case ast.Call(func=ast.Attribute(attr="setdefault"), args=[key, _]):
            return bool(_names(key))
    return False


def _is_asked_for(change: ast.AST, asked: Sequence[tuple[int, set[str]]], given: set[str]) -> bool:
    before = [names for line, names in asked if line <= getattr(change, "lineno", 0)]
    names = _names(change)
    return any(looked_for & names for looked_for in before) or (bool(before) and not names & given)


def _asked(nodes: Sequence[ast.AST], name: str) -> Iterator[tuple[int, set[str]]]:
    """Yield where something is looked for in what has a name, with the names of what that is."""
    for node in nodes:
        match node:
            case ast.Compare(left=left, ops=[ast.In() | ast.NotIn()], comparators=[other]) if name in _names(
                other
            ):
                yield node.lineno, _names(left) - {name}
            case ast.Call(func=ast.Attribute(value=ast.Name(id=found), attr="get"), args=[key, *_]) if (
                found == name
            ):
                yield node.lineno, _names(key)
            case ast.Try(body=body):
                inner = [item for part in body for item in ast.walk(part)]
                yield from ((node.lineno, _names(key)) for key in _keys(inner, name))
            case ast.If(test=test) | ast.IfExp(test=test) | ast.While(test=test) if name in _names(test):
                yield node.lineno, set()


def _keys(nodes: Sequence[ast.AST], name: str) -> Iterator[ast.expr]:
    for node in nodes:
        match node:
            case ast.Subscript(value=ast.Name(id=found), slice=key, ctx=ast.Load()) if found == name:
                yield key


def _is_handed_on(nodes: Sequence[ast.AST], name: str) -> bool:
    """Return whether a keyword is given the whole of it, alone or in a list."""
    for node in nodes:
        match node:
            case ast.keyword(value=ast.Name()):
                items: list[ast.expr] = [node.value]
            case ast.keyword(value=ast.List(elts=items) | ast.Tuple(elts=items)):
                pass
            case _:
                continue
        plain = (item.value if isinstance(item, ast.Starred) else item for item in items)
        if any(isinstance(item, ast.Name) and item.id == name for item in plain):
            return True
    return False


def _names(node: ast.AST) -> set[str]:
    return {item.id for item in ast.walk(node) if isinstance(item, ast.Name)}
