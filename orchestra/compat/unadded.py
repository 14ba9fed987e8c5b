"""Actions that code makes and adds to nothing: it has no way to them, as the whole file shows.

Only what is certain is told. A name that stands anywhere else, be it in a comment, is left alone: what people leave out
for a while is hardly ever a mistake.
"""

from __future__ import annotations

import ast
import linecache
import re
from collections import Counter
from typing import TYPE_CHECKING, Final

from orchestra.compat.idle_names import ACTIONS, PROCESSES
from orchestra.compat.literals import keyword
from orchestra.compat.syntax_trees import called_by, node_span, tree_of
from orchestra.errors import Code
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from orchestra.compat.place import Place
    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problems
    from orchestra.location import Span

_TARGETS: Final = ("target_action", "target_lifecycle_node")
# Code that reaches variables in another way than by their names.
_REACHING: Final = frozenset({"dir", "eval", "exec", "globals", "locals", "vars"})


def tell_unadded(path: str, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of the actions of a file that are part of no launch description."""
    tree = _tree(path)
    if tree is None:
        return
    counts = Counter(node.id for node in tree.nodes if isinstance(node, ast.Name))
    for name in _made(tree, lambda name: counts[name] == 1):
        if not _is_remarked(name.id, path):
            described = _description(tree)
            way = f"; {described}.add_action({name.id}) adds it" if described is not None else ""
            told = f"'{name.id}' is added to no launch description: it has no effect{way}"
            problems.warning(Code.USER_CODE, told, Location(node_span(path, name), chain))


def _description(tree: Tree) -> str | None:
    """Return the variable that alone is set to a launch description which actions are added to."""
    found = {
        node.targets[0].id
        for node in tree.nodes
        if isinstance(node, ast.Assign)
        and isinstance(node.targets[0], ast.Name)
        and called_by(node.value) == "LaunchDescription"
    }
    adding = any(called_by(node) == "add_action" for node in tree.nodes)
    return found.pop() if len(found) == 1 and adding else None


def target_unadded(handler: Place) -> Span | None:
    """Return where the call of an event handler names what it waits for, if that is part of no launch description."""
    tree = _tree(handler.file)
    targets = [] if tree is None else [keyword(handler, name).node for name in _TARGETS]
    for target in targets:
        if tree is None or target is None:
            continue
        if isinstance(target, ast.Name):
            made = next(_made(tree, target.id.__eq__), None)
            waiting = list(_targets(tree))
            is_sure = made is not None and all(item in waiting for item in _others(made, tree))
            if not is_sure or _is_remarked(target.id, handler.file):
                continue
        elif called_by(target) not in PROCESSES:
            continue
        return node_span(handler.file, target)
    return None


def _tree(path: str) -> Tree | None:
    """Return the tree of a file, None where its code reaches variables in another way than by their names."""
    tree = tree_of(path)
    return None if tree is None or any(called_by(node) in _REACHING for node in tree.nodes) else tree


def _made(tree: Tree, wanted: Callable[[str], bool]) -> Iterator[ast.Name]:
    """Yield the variables of functions with a name that is wanted where they are set to an action."""
    for node in tree.nodes:
        match node:
            case ast.Assign(targets=[ast.Name() as name], value=value) if called_by(value) in ACTIONS:
                if wanted(name.id) and not name.id.startswith("_") and any(tree.functions_around(node)):
                    yield name


def _others(name: ast.Name, tree: Tree) -> list[ast.expr]:
    """Return where a name stands besides."""
    return [
        item for item in tree.nodes if isinstance(item, ast.Name) and item.id == name.id and item is not name
    ]


def _targets(tree: Tree) -> Iterator[ast.expr]:
    """Yield what event handlers wait for."""
    for node in tree.nodes:
        match node:
            case ast.Call(keywords=words):
                yield from (word.value for word in words if word.arg in _TARGETS)


def _is_remarked(name: str, path: str) -> bool:
    """Return whether a name stands in a comment of a file."""
    comments = "".join(line.partition("#")[2] for line in linecache.getlines(path))
    return re.search(rf"\b{re.escape(name)}\b", comments) is not None
