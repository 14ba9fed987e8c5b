"""Statements that are never reached: behind a `return`, or behind the one that ends a loop in its first round."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Final

from orchestra.compat.scopes import Function
from orchestra.compat.syntax_trees import node_span
from orchestra.errors import Code
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problems
    from orchestra.location import Span

_ADDING: Final = frozenset({"add_action", "add_entity", "append", "extend", "insert"})
_HARMLESS: Final = (ast.Pass, ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Return, ast.Raise)


def tell_unreached(path: str, tree: Tree, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of statements that end what should go on."""
    for function in tree.nodes:
        if isinstance(function, Function):
            for node, message in _faults(function):
                span = node_span(path, node)
                if isinstance(node, ast.Return):
                    span = type(span)(
                        span.file, span.line, span.column, span.line, span.column + len("return")
                    )
                problems.warning(Code.USER_CODE, message, Location(span, chain))


def _faults(function: Function) -> Iterator[tuple[ast.stmt, str]]:
    for block in _blocks(function.body):
        ends = next((index for index, item in enumerate(block) if isinstance(item, ast.Return)), None)
        behind = block[ends + 1 :] if ends is not None else []
        if any(isinstance(item, ast.Yield | ast.YieldFrom) for rest in behind for item in ast.walk(rest)):
            behind = []  # what makes a generator of a function that yields nothing
        reached = next((item for item in behind if not isinstance(item, _HARMLESS) and _does(item)), None)
        if reached is not None:
            yield reached, "this is never reached: the function returns before it"
        for item in block:
            if isinstance(item, ast.For) and _is_ended(item):
                yield item.body[-1], "the loop ends here in its first round: `return` stands too deep"


def _does(node: ast.stmt) -> bool:
    """Return whether a statement adds something, or makes it for one that does."""
    return any(isinstance(item, ast.Call) for item in ast.walk(node))


def _is_ended(loop: ast.For) -> bool:
    """Return whether a loop adds something, and returns in its first round whatever comes."""
    adding = any(
        isinstance(item, ast.Expr)
        and isinstance(item.value, ast.Call)
        and isinstance(item.value.func, ast.Attribute)
        and item.value.func.attr in _ADDING
        for item in loop.body
    )
    leaves = any(isinstance(item, ast.Continue) for item in ast.walk(loop))
    return adding and not leaves and isinstance(loop.body[-1], ast.Return)


def _blocks(body: Sequence[ast.stmt]) -> Iterator[Sequence[ast.stmt]]:
    """Yield the blocks of a function, without those of functions inside of it."""
    yield body
    for item in body:
        if isinstance(item, Function | ast.ClassDef):
            continue
        for name in ("body", "orelse", "finalbody"):
            inner = getattr(item, name, None)
            if isinstance(inner, list) and inner:
                yield from _blocks(inner)
        for handler in getattr(item, "handlers", ()):
            yield from _blocks(handler.body)
