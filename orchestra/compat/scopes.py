"""Scopes of the user's Python: what stands in one, names that are set there, and what its parts are given or ask."""

from __future__ import annotations

import ast
from collections import deque
from typing import TYPE_CHECKING, Final, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Iterator

Function: TypeAlias = ast.FunctionDef | ast.AsyncFunctionDef

# What may set names, and what may decide by something: of a file's nodes few are such, and all are asked.
_SETTING: Final = frozenset(
    {
        *(ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Import, ast.ImportFrom, ast.Assign),
        *(ast.Delete, ast.AnnAssign, ast.AugAssign, ast.NamedExpr, ast.For, ast.AsyncFor, ast.comprehension),
        ast.withitem,
    }
)
_DECIDING: Final = frozenset(
    {ast.If, ast.While, ast.IfExp, ast.Assert, ast.Call, ast.ListComp, ast.GeneratorExp}
)


def of_scope(scope: Function | ast.Module) -> Iterator[ast.AST]:
    """Yield what stands in a scope, without what is in functions and classes inside of it."""
    waiting = deque[ast.AST](scope.body)
    while waiting:
        node = waiting.popleft()
        yield node
        if not isinstance(node, Function | ast.ClassDef | ast.Lambda):
            waiting.extend(ast.iter_child_nodes(node))


def names_set(node: ast.AST) -> Iterator[str]:
    """Yield the names that a statement or a target sets."""
    if type(node) not in _SETTING:
        return
    if isinstance(node, Function | ast.ClassDef):
        yield node.name
    elif isinstance(node, ast.Import | ast.ImportFrom):
        yield from (item.asname or item.name for item in node.names)
    for target in _targets(node):
        yield from (item.id for item in ast.walk(target) if isinstance(item, ast.Name))


def _targets(node: ast.AST) -> list[ast.expr]:
    match node:
        case ast.Assign(targets=targets) | ast.Delete(targets=targets):
            return targets
        case ast.AnnAssign(target=target) | ast.AugAssign(target=target) | ast.NamedExpr(target=target):
            return [target]
        case ast.For(target=target) | ast.AsyncFor(target=target) | ast.comprehension(target=target):
            return [target]
        case ast.withitem(optional_vars=target) if target is not None:
            return [target]
    return []


def value_of(node: ast.AST, name: str) -> ast.expr | None:
    """Return what a name alone is set to by a statement, None where it is set in another way."""
    match node:
        case ast.Assign(targets=[ast.Name(id=found)], value=value) if found == name:
            return value
        case ast.AnnAssign(target=ast.Name(id=found), value=value) if found == name:
            return value
    return None


def parameters(function: Function) -> set[str]:
    """Return the names of what a function is given."""
    given = function.args
    every = (*given.posonlyargs, *given.args, *given.kwonlyargs, given.vararg, given.kwarg)
    return {item.arg for item in every if item is not None}


def decided_by(node: ast.AST) -> list[ast.expr]:
    """Return what a statement or an expression decides by, with what `and`, `or` and `not` are put between."""
    if type(node) not in _DECIDING:
        return []
    match node:
        case ast.If(test=test) | ast.While(test=test) | ast.IfExp(test=test) | ast.Assert(test=test):
            return [test]
        case ast.Call(func=ast.Name(id="bool"), args=[given], keywords=[]):
            return [given]
        case ast.ListComp(generators=parts) | ast.GeneratorExp(generators=parts):
            return [test for part in parts for test in part.ifs]
    return []


def given_to(call: ast.Call) -> Iterator[ast.expr]:
    """Yield what a call is given, and in place of lists their items."""
    for item in (*call.args, *(word.value for word in call.keywords)):
        yield from item.elts if isinstance(item, ast.List | ast.Tuple) else (item,)
