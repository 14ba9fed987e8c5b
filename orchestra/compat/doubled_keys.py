"""A name that stands twice in one dictionary with different values: Python takes the last one without a word."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from orchestra.compat.syntax_trees import node_span, tree_of
from orchestra.errors import Code
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.errors import Problems
    from orchestra.location import Span


def tell_doubled_keys(path: str, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of names in the dictionaries of a file that stand there before, with another value."""
    tree = tree_of(path)
    for node in () if tree is None else tree.nodes:
        for name, key, first in _doubled(node):
            at = Location(node_span(path, key), chain)
            message = f"'{name}' is given twice: the last one counts"
            notes = (f"the other one is at {node_span(path, first)}",)
            problems.warning(Code.DUPLICATE_KEY, message, at, notes=notes)


def _doubled(node: ast.AST) -> Iterator[tuple[str, ast.expr, ast.expr]]:
    """Yield the names of a dictionary that stand there before, where they do so now, and where before."""
    before: dict[str, tuple[ast.expr, str]] = {}
    pairs = zip(node.keys, node.values, strict=True) if isinstance(node, ast.Dict) else ()
    for key, value in pairs:
        match key:
            case ast.Constant(value=str(name)):
                code = ast.dump(value)
                first, known = before.setdefault(name, (key, code))
                if known != code:
                    yield name, key, first
