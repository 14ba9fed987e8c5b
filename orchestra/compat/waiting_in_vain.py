"""Actions that wait for each other: each is only launched by a handler of what is launched by one of the others."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from orchestra.compat.syntax_trees import node_span
from orchestra.compat.unadded import TARGETS, made_of, names_of, sure_tree, targets_of
from orchestra.errors import Code
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problems
    from orchestra.location import Span


def tell_waiting_in_vain(path: str, tree: Tree, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of such actions, where the last of them is waited for."""
    causes = {} if sure_tree(path) is None else _in_vain(tree)
    ring = _ring(causes)
    places = [name for name in targets_of(tree) if isinstance(name, ast.Name) and name.id in ring]
    if not places:
        return
    last = max(places, key=lambda name: (name.lineno, name.col_offset))
    if len(ring) == 1:
        message = f"'{ring[0]}' waits for itself: it never starts"
    else:
        pairs = zip(ring, (*ring[1:], ring[0]), strict=True)
        told = ", ".join(f"'{name}' waits for '{other}'" for name, other in pairs)
        message = f"{told}: none of them ever starts"
    problems.warning(Code.DEPENDENCY_CYCLE, message, Location(node_span(path, last), chain))


def _in_vain(tree: Tree) -> dict[str, set[str]]:
    """Return the actions that are only launched by handlers of such actions, and what these wait for."""
    handlers, targets = list(_handlers(tree)), targets_of(tree)
    causes: dict[str, set[str]] = {}
    for name, written in made_of(tree).items():
        others = [item for item in names_of(tree)[name] if item is not written and item not in targets]
        found = [
            target.id
            for item in others
            for target, inside in handlers
            if isinstance(target, ast.Name) and item in inside
        ]
        if others and len(found) == len(others):
            causes[name] = set(found)
    while True:
        vain = {name: of for name, of in causes.items() if of <= causes.keys()}
        if len(vain) == len(causes):
            return vain
        causes = vain


def _handlers(tree: Tree) -> Iterator[tuple[ast.expr, set[ast.AST]]]:
    """Yield what each event handler waits for, and all that stands in what it does."""
    for node in tree.nodes:
        words = node.keywords if isinstance(node, ast.Call) else []
        target = next((word.value for word in words if word.arg in TARGETS), None)
        if target is not None:
            given = (word.value for word in words if word.value is not target)
            yield target, {item for value in given for item in ast.walk(value)}


def _ring(causes: dict[str, set[str]]) -> list[str]:
    """Return actions of which each waits for the next one, and the last one for the first."""
    way: list[str] = []
    name = min(causes, default=None)
    while name is not None and name not in way:
        way.append(name)
        name = min(causes[name], default=None)
    return way[way.index(name) :] if name is not None else []
