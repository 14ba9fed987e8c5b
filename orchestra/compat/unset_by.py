"""Declarations that are part of no launch description: that what they declare is not set is told of them, once."""

from __future__ import annotations

import ast
import re
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.compat.syntax_trees import called_by, node_span, tree_of
from orchestra.errors import Code, Severity
from orchestra.fields import replace

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problem
    from orchestra.location import Span

_IDLE: Final = re.compile(r".* no launch description: it has no effect")
_UNSET: Final = re.compile(r"no launch argument or variable '([^']*)' is set here")
_DECLARING: Final = frozenset({"DeclareLaunchArgument", "SetLaunchConfiguration"})
_ADDING: Final = frozenset({"add_action", "add_entity", "append", "extend", "insert"})


def without_readings(problems: Iterable[Problem]) -> Callable[[Problem], Problem | None]:
    """Return what leaves out that a value is not set, of the values whose declarations are told to be left out.

    What is told of these is an error then: the launch fails.
    """
    unset = _unset(problems)
    causes = {} if not unset else {id(problem): _declared(problem) & unset.keys() for problem in problems}
    declared = frozenset().union(*causes.values())

    def kept(problem: Problem) -> Problem | None:
        found = _UNSET.match(problem.message) if problem.code is Code.UNDEFINED_VARIABLE else None
        if found is not None and found[1] in declared:
            return None
        names = causes.get(id(problem))
        if not names:
            return problem
        worst = min((unset[name] for name in names), key=list(Severity).index)
        told = problem.message.replace(
            "it has no effect", f"nothing sets {', '.join(map(repr, sorted(names)))}"
        )
        return replace(problem, severity=worst, message=told)

    return kept


def _unset(problems: Iterable[Problem]) -> dict[str, Severity]:
    """Return the values that are told to be set nowhere, and how grave that is."""
    found: dict[str, Severity] = {}
    for problem in problems:
        sign = _UNSET.match(problem.message) if problem.code is Code.UNDEFINED_VARIABLE else None
        if sign is not None:
            known = found.get(sign[1])
            found[sign[1]] = Severity.ERROR if known is Severity.ERROR else problem.severity
    return found


def _declared(problem: Problem) -> frozenset[str]:
    """Return the values that something sets which is told to be part of no launch description."""
    span = problem.span
    if span is None or problem.code is not Code.USER_CODE or not _IDLE.match(problem.message):
        return frozenset()
    file = str(Path(span.file).absolute())
    tree = tree_of(file)
    return frozenset() if tree is None else frozenset(_names(file, span, tree))


def _names(file: str, span: Span, tree: Tree) -> Iterator[str]:
    for node in tree.nodes:
        match node:
            case ast.Assign(targets=[ast.Name() as name], value=value) if _is_at(file, name, span):
                yield from _set_by(value, tree)
                yield from (word for given in _added_to(name.id, tree) for word in _set_by(given, tree))
            case ast.Expr(value=ast.Call(func=ast.Name() as name) as call) if _is_at(file, name, span):
                yield from _set_by(call, tree)


def _is_at(file: str, name: ast.Name, span: Span) -> bool:
    at = node_span(file, name)
    return (at.line, at.column) == (span.line, span.column)


def _added_to(name: str, tree: Tree) -> Iterator[ast.expr]:
    for node in tree.nodes:
        match node:
            case ast.Call(func=ast.Attribute(value=ast.Name(id=held), attr=attr), args=given):
                if held == name and attr in _ADDING:
                    yield from given


def _set_by(value: ast.expr, tree: Tree) -> Iterator[str]:
    """Yield the names of what the declarations in an expression set."""
    for node in ast.walk(tree.meaning(value)):
        if isinstance(node, ast.expr) and called_by(tree.meaning(node)) in _DECLARING:
            call = tree.meaning(node)
            words = call.keywords if isinstance(call, ast.Call) else []
            named = [word.value for word in words if word.arg == "name"]
            first = named or (call.args[:1] if isinstance(call, ast.Call) else [])
            known = [tree.meaning(item) for item in first]
            yield from (str(item.value) for item in known if isinstance(item, ast.Constant))
