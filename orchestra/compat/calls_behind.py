"""Calls behind a mistake that nobody knows how to go on from: keywords that their classes do not have.

They are read, not run: only calls that the file comes to by every way are told of.
"""

from __future__ import annotations

import ast
from collections import deque
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.borrowed import ROOM
from orchestra.compat.keywords import keyword_meant, parameters_of
from orchestra.compat.refusing import Refusing
from orchestra.compat.syntax_trees import node_span, tree_of
from orchestra.errors import Code
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.errors import Problems
    from orchestra.location import Span

# What is in these may never be run.
_PERHAPS: Final = (
    ast.BoolOp,
    ast.ClassDef,
    ast.DictComp,
    ast.For,
    ast.GeneratorExp,
    ast.If,
    ast.IfExp,
    ast.Lambda,
    ast.ListComp,
    ast.Match,
    ast.SetComp,
    ast.Try,
    ast.While,
    ast.With,
)


def tell_keywords(file: str, function: str, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Report keywords that classes of the launch language do not have, in a file and in one function of it."""
    tree = tree_of(file)
    body = [] if tree is None else tree.module.body
    kinds = dict(_imported(body))
    for name in () if tree is None else filter(None, map(_set, ast.walk(tree.module))):
        kinds.pop(name, None)
    inside = [node for node in body if isinstance(node, ast.FunctionDef) and node.name == function]
    for call in _calls([*body, *(statement for node in inside for statement in node.body)]):
        kind = kinds.get(call.func.id) if isinstance(call.func, ast.Name) else None
        if kind is None:
            continue
        known = {item.name: item for item in parameters_of(kind)}
        given = [word.arg for word in call.keywords if word.arg is not None]
        for word in call.keywords:
            if word.arg is not None and word.arg not in known:
                message = f"{kind.__name__} has no argument '{word.arg}'"
                at = Location(node_span(file, word), chain)
                problems.error(
                    Code.UNKNOWN_KEY, message, at, suggestion=keyword_meant(word.arg, known, given)
                )


def _imported(body: list[ast.stmt]) -> Iterator[tuple[str, type[Any]]]:
    """Yield the classes of the launch language that a file imports, by the names that it has for them."""
    for node in body:
        module = (node.module or "") if isinstance(node, ast.ImportFrom) else ""
        if isinstance(node, ast.ImportFrom) and module.partition(".")[0] in ("launch", "launch_ros"):
            held = import_module(f"{ROOM}.{module}") if _is_there(f"{ROOM}.{module}") else None
            every = [(name, name) for name in getattr(held, "__all__", ())]
            names = [(item.name, item.asname or item.name) for item in node.names]
            for name, own in every if names == [("*", "*")] else names:
                kind = getattr(held, name, None)
                if isinstance(kind, type) and issubclass(kind, Refusing):
                    yield own, kind


def _set(node: ast.AST) -> str | None:
    """Return the name that a node gives another meaning."""
    if isinstance(node, ast.Name):
        return node.id if isinstance(node.ctx, ast.Store) else None
    return node.name if isinstance(node, ast.FunctionDef | ast.ClassDef) else None


def _is_there(module: str) -> bool:
    try:
        return find_spec(module) is not None
    except ModuleNotFoundError:
        return False


def _calls(body: list[ast.stmt]) -> Iterator[ast.Call]:
    """Yield the calls that stand in no branch, loop or function, the outer ones first."""
    waiting: deque[ast.AST] = deque(body)
    while waiting:
        node = waiting.popleft()
        if isinstance(node, ast.Call):
            yield node
        if not isinstance(node, (*_PERHAPS, ast.FunctionDef, ast.AsyncFunctionDef)):
            waiting.extend(ast.iter_child_nodes(node))
