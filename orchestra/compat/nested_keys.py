"""A parameter that is given twice, once by a name with dots and once in a dictionary, or in two of a list."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Final

from orchestra.compat.syntax_trees import node_span
from orchestra.errors import Code
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problems
    from orchestra.location import Span

_HOLDING: Final = frozenset({"parameters", "ros_parameters"})


def tell_nested_keys(path: str, tree: Tree, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of such parameters in a file."""
    inner = {id(value) for node in tree.nodes if isinstance(node, ast.Dict) for value in node.values}
    for node in tree.nodes:
        found: Iterator[tuple[str, ast.expr, ast.expr]] = iter(())
        if isinstance(node, ast.Dict) and id(node) not in inner:
            found = _twice([node], within=True)
        elif isinstance(node, ast.Call):
            lists = [word.value for word in node.keywords if word.arg in _HOLDING]
            held = lists[0].elts if lists and isinstance(lists[0], ast.List) else []
            found = _twice([item for item in held if isinstance(item, ast.Dict)], within=False)
        for name, key, first in found:
            notes = (f"the other one is at {node_span(path, first)}",)
            message = f"'{name}' is given twice: the last one counts"
            at = Location(node_span(path, key), chain)
            problems.warning(Code.DUPLICATE_KEY, message, at, notes=notes)


def _twice(given: list[ast.Dict], *, within: bool) -> Iterator[tuple[str, ast.expr, ast.expr]]:
    """Yield the parameters that are given with two values, where they are so last, and where before.

    Within a dictionary they are those of which the names are written in different ways.
    """
    known: dict[str, tuple[ast.expr, ast.expr, int]] = {}
    for index, node in enumerate(given):
        for name, key, value in _leaves(node, ""):
            before = known.get(name)
            known[name] = (key, value, index)
            if before is None:
                continue
            is_other = _text(before[0]) != _text(key) if within else before[2] != index
            is_plain = within or (isinstance(value, ast.Constant) and isinstance(before[1], ast.Constant))
            if is_other and is_plain and ast.dump(before[1]) != ast.dump(value):
                yield name, key, before[0]


def _leaves(node: ast.Dict, prefix: str) -> Iterator[tuple[str, ast.expr, ast.expr]]:
    for key, value in zip(node.keys, node.values, strict=True):
        if not isinstance(key, ast.Constant) or not isinstance(key.value, str):
            continue
        name = f"{prefix}{key.value}"
        if isinstance(value, ast.Dict):
            yield from _leaves(value, f"{name}.")
        else:
            yield name, key, value


def _text(key: ast.expr) -> object:
    return key.value if isinstance(key, ast.Constant) else None
