"""Values that are None for want of an environment variable: what they lead to is the fault of this host alone."""

from __future__ import annotations

import ast
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.compat.syntax_trees import Tree, node_span, tree_of
from orchestra.errors import Code, Severity
from orchestra.fields import replace
from orchestra.location import is_python

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from orchestra.errors import Problem
    from orchestra.location import Span

_READING = frozenset({"os.getenv", "getenv", "os.environ.get", "environ.get"})
_ENVIRONMENT = frozenset({"os.environ", "environ"})
_CODES = frozenset({Code.USER_CODE, Code.WRONG_TYPE, Code.BAD_VALUE, Code.MISSING_FILE, Code.NOT_A_CHOICE})
_ENDING = frozenset({"SystemExit", "exit", "quit", "sys.exit"})


def left_open(problem: Problem, unset: Callable[[str], str | None], weight: Severity) -> Problem:
    """Return an error, or what an argument or this machine lacks, as one of the variable that has led to it.

    Sure is that where an expression that cannot use None, or a text with it, is made of `os.getenv` without a default,
    and where code itself stops for it; so is that where a text is none of the choices that is empty unless it is set.
    `unset` has what is to be told of a variable, None where it is set; it weighs
    so much.
    """
    span = problem.span
    lacks = problem.code is Code.MISSING_ARGUMENT
    if not lacks and (problem.severity is Severity.WARNING or problem.code not in _CODES):
        return problem
    if span is None or not is_python(span):
        return problem
    file = str(Path(span.file).absolute())
    tree = tree_of(file)
    if tree is None:
        return problem
    instead = "" if problem.code is Code.NOT_A_CHOICE else None
    for name, node in (
        read for place in _places(problem, tree, file, span) for read in _reads(place, tree, set(), instead)
    ):
        told = unset(name)
        if told is not None:
            at = node_span(file, node)
            return replace(
                problem,
                code=Code.UNSET_ENVIRONMENT,
                severity=weight,
                message=told,
                span=at,
                suggestion=None,
                notes=(),
            )
    return problem


def _places(problem: Problem, tree: Tree, file: str, span: Span) -> Iterator[ast.AST]:
    """Yield the expressions of which an error may come: where it is, what is assigned there, what was asked before."""
    whole = tree.expression(file, span)
    if problem.code is Code.MISSING_ARGUMENT:
        yield from () if whole is None else _defaults(tree, whole)
    elif ("None" in problem.message or problem.code is Code.NOT_A_CHOICE) and whole is not None:
        yield whole
    if problem.code is Code.USER_CODE:
        assigned = _assignment(tree, span.line) if "None" in problem.message else None
        yield from () if assigned is None else (assigned,)
        yield from _reasons(tree, span.line)


def _defaults(tree: Tree, name: ast.expr) -> Iterator[ast.expr]:
    """Yield the default of an argument that is declared by a name."""
    call = _calls(tree).get(name)
    if call is not None:
        yield from (item.value for item in call.keywords if item.arg == "default_value")


@lru_cache(maxsize=4)  # of one file, a thousand arguments may be missing
def _calls(tree: Tree) -> dict[ast.expr, ast.Call]:
    """Return the calls by what they are given."""
    calls = (node for node in tree.nodes if isinstance(node, ast.Call))
    return {given: node for node in calls for given in (*node.args, *(item.value for item in node.keywords))}


def _assignment(tree: Tree, line: int) -> ast.AST | None:
    """Return what is assigned on a line."""
    kinds = ast.Assign | ast.AugAssign
    return next((node.value for node in tree.nodes if isinstance(node, kinds) and node.lineno == line), None)


def _reasons(tree: Tree, line: int) -> list[ast.expr]:
    """Return what is asked where code ends itself on a line: the tests that it stands right below."""
    return [
        node.test
        for node in tree.nodes
        if isinstance(node, ast.If)
        for inner in node.body
        if inner.lineno <= line <= (inner.end_lineno or 0) and _ends(inner)
    ]


def _ends(statement: ast.stmt) -> bool:
    if isinstance(statement, ast.Raise):
        return True
    call = statement.value if isinstance(statement, ast.Expr) else None
    return isinstance(call, ast.Call) and ast.unparse(call.func) in _ENDING


def _reads(
    node: ast.AST, tree: Tree, seen: set[int], instead: str | None = None
) -> Iterator[tuple[str, ast.expr]]:
    """Yield the variables that are read in an expression and what its names stand for: such as are `instead` if unset.

    That is None for those that are read without a default.
    """
    for part in ast.walk(node):
        meant = tree.meaning(part) if isinstance(part, ast.Name) else part
        if id(meant) in seen:
            continue
        seen.add(id(meant))
        match meant:
            case ast.Call(func=func, args=[ast.Constant(value=str(name)) as key], keywords=[]):
                if instead is None and ast.unparse(func) in _READING:
                    yield name, key
            case ast.Call(
                func=func,
                args=[ast.Constant(value=str(name)) as key, ast.Constant(value=default)],
                keywords=[],
            ):
                if instead is not None and default == instead and ast.unparse(func) in _READING:
                    yield name, key
            case ast.Compare(
                left=ast.Constant(value=str(name)) as key, ops=[ast.NotIn()], comparators=[asked]
            ):
                if ast.unparse(asked) in _ENVIRONMENT:
                    yield name, key
        if meant is not part:
            yield from _reads(meant, tree, seen, instead)
