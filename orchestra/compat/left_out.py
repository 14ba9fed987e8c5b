"""What code of a launch file makes for a launch description and leaves out of it: lists, declarations, calls alone.

What stands in a variable of an action that is never read is told elsewhere. A name that stands in a comment is left
alone, as there: what people leave out for a while is hardly ever a mistake.
"""

from __future__ import annotations

import ast
import linecache
import re
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.compat.idle_names import ACTIONS
from orchestra.compat.scopes import Function, of_scope
from orchestra.compat.syntax_trees import called_by, node_span
from orchestra.errors import Code, Severity
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problems
    from orchestra.location import Span

_Added: TypeAlias = dict[str, list[tuple[ast.Name, list[ast.expr]]]]

_WORD: Final = re.compile(r"\w+")
_ADDING: Final = frozenset({"add_action", "add_entity", "append", "extend", "insert"})
_SETTING: Final = frozenset(
    {
        *("AppendEnvironmentVariable", "DeclareLaunchArgument", "LogInfo", "PushROSNamespace"),
        *("PushRosNamespace", "SetEnvironmentVariable", "SetLaunchConfiguration", "SetParameter", "SetRemap"),
    }
)
MADE: Final = ACTIONS | _SETTING
_REACHING: Final = frozenset({"dir", "eval", "exec", "globals", "locals", "vars"})


def tell_left_out(path: str, tree: Tree, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of such things in a file."""
    is_left = any(
        problem.code is Code.USER_CODE and problem.severity is Severity.ERROR for problem in problems
    )
    if is_left or any(called_by(node) in _REACHING for node in tree.nodes):
        return  # code that has raised something may have used it
    remarked = {
        word
        for line in linecache.getlines(path)
        for word in _WORD.findall(line.partition("#")[2] if "#" in line else "")
    }
    own = {node.name for node in tree.nodes if isinstance(node, Function | ast.ClassDef)}
    for function in tree.nodes:
        if isinstance(function, Function) and any(map(_returns_something, of_scope(function))):
            for node, message in _left_out(function, remarked, own):
                problems.warning(Code.USER_CODE, message, Location(node_span(path, node), chain))


def _returns_something(node: ast.AST) -> bool:
    return isinstance(node, ast.Return) and node.value is not None


def _left_out(function: Function, remarked: set[str], own: set[str]) -> Iterator[tuple[ast.expr, str]]:
    inside = list(of_scope(function))
    yield from (item for item in _alone(inside) if item[0].id not in own)
    names: dict[str, list[ast.Name]] = {}
    for node in ast.walk(function):
        if isinstance(node, ast.Name):
            names.setdefault(node.id, []).append(node)
        elif isinstance(node, ast.Global | ast.Nonlocal):
            remarked = remarked | set(node.names)
    added = _added(inside)
    for name, first in _kept(inside, added).items():
        adding = {id(held) for held, _ in added.get(name, ())}
        reads = [node for node in names[name] if isinstance(node.ctx, ast.Load) and id(node) not in adding]
        is_lists = first[1]
        if reads or name in remarked or name.startswith("_") or (not is_lists and adding):
            continue
        yield first[0], f"'{name}' is part of no launch description: it has no effect"


def _alone(inside: list[ast.AST]) -> Iterator[tuple[ast.Name, str]]:
    """Yield the actions that statements make, and nothing else."""
    for node in inside:
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Call):
            name = called_by(node.value)
            if name in MADE and isinstance(node.value.func, ast.Name):
                yield node.value.func, f"this {name} is added to no launch description: it has no effect"


def _kept(inside: list[ast.AST], added: _Added) -> dict[str, tuple[ast.Name, bool]]:
    """Return the variables that are set to what is made, where first, and whether to a list or a description."""
    found: dict[str, tuple[ast.Name, bool]] = {}
    for node in inside:
        match node:
            case ast.Assign(targets=[ast.Name() as name], value=value):
                is_held = isinstance(value, ast.List) or called_by(value) == "LaunchDescription"
                is_made = called_by(value) in _SETTING
                given = (item for _, items in added.get(name.id, ()) for item in items)
                if is_made or (is_held and (_makes(value) or any(map(_makes, given)))):
                    found.setdefault(name.id, (name, is_held))
    return found


def _makes(value: ast.AST) -> bool:
    items = value.elts if isinstance(value, ast.List) else [value]
    return any(called_by(item) in MADE for item in items)


def _added(inside: list[ast.AST]) -> _Added:
    """Return where something is only added to a variable, and what, by the name of that."""
    found: _Added = {}
    for node in inside:
        match node:
            case ast.Expr(
                value=ast.Call(func=ast.Attribute(value=ast.Name() as held, attr=attr), args=given)
            ) if attr in _ADDING:
                found.setdefault(held.id, []).append((held, given))
    return found
