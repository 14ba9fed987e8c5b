"""Actions that code makes and adds to nothing: it has no way to them, as the whole file shows.

Only what is certain is told. A name that stands anywhere else, be it in a comment, is left alone: what people leave out
for a while is hardly ever a mistake.
"""

from __future__ import annotations

import ast
import linecache
from functools import lru_cache
from typing import TYPE_CHECKING, Final

from orchestra.compat.idle_names import ACTIONS, PROCESSES
from orchestra.compat.literals import keyword
from orchestra.compat.syntax_trees import called_by, node_span, tree_of
from orchestra.errors import Code
from orchestra.location import Location
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from orchestra.compat.place import Place
    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problems
    from orchestra.location import Span

_WORD: Final = pattern(r"\w+")
TARGETS: Final = ("target_action", "target_lifecycle_node")
# Code that reaches variables in another way than by their names.
_REACHING: Final = frozenset({"dir", "eval", "exec", "globals", "locals", "vars"})


def tell_unadded(path: str, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of the actions of a file that are part of no launch description."""
    tree = sure_tree(path)
    if tree is None:
        return
    for name in made_of(tree).values():
        if len(names_of(tree)[name.id]) == 1 and name.id not in remarked_of(
            "".join(linecache.getlines(path))
        ):
            described = _description(tree)
            way = f"; {described}.add_action({name.id}) adds it" if described is not None else ""
            told = f"'{name.id}' is added to no launch description: it has no effect{way}"
            problems.warning(Code.USER_CODE, told, Location(node_span(path, name), chain))


@lru_cache(maxsize=4)  # a thousand actions of a file may be part of nothing
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
    tree = sure_tree(handler.file)
    targets = [] if tree is None else [keyword(handler, name).node for name in TARGETS]
    for target in targets:
        if tree is None or target is None:
            continue
        if isinstance(target, ast.Name):
            made, waiting = made_of(tree).get(target.id), targets_of(tree)
            is_sure = made is not None and all(
                item in waiting for item in names_of(tree)[target.id] if item is not made
            )
            if not is_sure or target.id in remarked_of("".join(linecache.getlines(handler.file))):
                continue
        elif called_by(target) not in PROCESSES:
            continue
        return node_span(handler.file, target)
    return None


def sure_tree(path: str) -> Tree | None:
    """Return the tree of a file, None where its code reaches variables in another way than by their names."""
    tree = tree_of(path)
    return None if tree is None or _reaches(tree) else tree


@lru_cache(maxsize=4)  # asked of each of the handlers in a file, as what follows
def _reaches(tree: Tree) -> bool:
    return any(called_by(node) in _REACHING for node in tree.nodes)


@lru_cache(maxsize=4)
def made_of(tree: Tree) -> dict[str, ast.Name]:
    """Return the variables of functions where they are set to an action."""
    found: dict[str, ast.Name] = {}
    for node in tree.nodes:
        match node:
            case ast.Assign(targets=[ast.Name() as name], value=value) if called_by(value) in ACTIONS:
                if not name.id.startswith("_") and any(tree.functions_around(node)):
                    found.setdefault(name.id, name)
    return found


@lru_cache(maxsize=4)
def names_of(tree: Tree) -> dict[str, list[ast.Name]]:
    """Return where each name stands."""
    found: dict[str, list[ast.Name]] = {}
    for node in tree.nodes:
        if isinstance(node, ast.Name):
            found.setdefault(node.id, []).append(node)
    return found


@lru_cache(maxsize=4)
def targets_of(tree: Tree) -> frozenset[ast.expr]:
    """Return what event handlers wait for."""
    calls = (node for node in tree.nodes if isinstance(node, ast.Call))
    return frozenset(word.value for node in calls for word in node.keywords if word.arg in TARGETS)


@lru_cache(maxsize=4)
def remarked_of(text: str) -> frozenset[str]:
    """Return the words that stand in the comments of a file."""
    return frozenset(word for line in text.splitlines() for word in _WORD.findall(line.partition("#")[2]))
