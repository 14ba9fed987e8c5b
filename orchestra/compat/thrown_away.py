"""Functions that make actions and return nothing: what they make is thrown away, for want of a `return`.

Only what is certain is told: each action that such a function makes stays in it, in a variable or a list of its own.
What is handed to anything else, visited, kept in an object or made in a function inside of it may be used there.
"""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from orchestra.compat.functions import found_in, span_of_name, statements_of
from orchestra.compat.idle_names import ACTIONS
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import called_by, node_span, tree_of
from orchestra.errors import Code

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.compat.scopes import Function
    from orchestra.errors import Problems
    from orchestra.location import Span

_ADDING: Final = frozenset({"add_action", "add_entity", "append", "extend", "insert"})
_INNER: Final = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Lambda, ast.Yield, ast.YieldFrom)


class Fault(NamedTuple):
    """What to say of a function, where, and what should stand there; and its last line."""

    message: str
    span: Span
    suggestion: str | None
    end: int

    def is_told(self, problems: Problems) -> bool:
        """Return whether something of what the function makes is told to be without effect."""
        return any(
            problem.code is Code.USER_CODE
            and problem.span is not None
            and problem.span.file == self.span.file
            and self.span.line <= problem.span.line <= self.end
            for problem in problems
        )


def without_return(function: Any) -> Fault | None:
    """Return what to say of a function that throws away what it makes, where, and what should stand there."""
    code = getattr(function, "__code__", None)
    found = None if code is None or ACTIONS.isdisjoint(code.co_names) else found_in(function)
    return None if found is None else _fault(found[0].co_filename, found[1])


def called_without_return(file: str, span: Span) -> Fault | None:
    """Return the same of the function of the file that the call at a place calls."""
    tree = tree_of(file)
    call = None if tree is None else tree.expression(file, span)
    match call:
        case ast.Call(func=ast.Name(id=name)) if tree is not None:
            known = [node for node in tree.nodes if isinstance(node, ast.FunctionDef) and node.name == name]
            return _fault(file, known[0]) if len(known) == 1 else None
    return None


def _fault(file: str, node: Function) -> Fault | None:
    returns = [item.value for item in statements_of(node) if isinstance(item, ast.Return)]
    kept = None if any(map(_is_something, returns)) else _kept(node)
    if kept is None:
        return None
    message = f"{node.name}() returns nothing: what it makes is thrown away, its `return` is missing"
    end = node.end_lineno or node.lineno
    match node.body[-1]:
        case ast.Expr(value=ast.Call(func=last) as call) if called_by(call) in ACTIONS:
            return Fault(message, node_span(file, last), Rewritten(f"return {_source(file, last)}"), end)
        case ast.Expr(value=ast.Name() | ast.List() as last):
            return Fault(message, node_span(file, last), Rewritten(f"return {_source(file, last)}"), end)
    if kept:
        message = f"{node.name}() returns nothing: `return {kept}` is missing, it is thrown away"
    return Fault(message, span_of_name(file, node), None, end)


def _source(file: str, node: ast.expr) -> str:
    return text_at(file, node_span(file, node))


def _is_something(value: ast.expr | None) -> bool:
    return value is not None and not (isinstance(value, ast.Constant) and value.value is None)


def _kept(function: Function) -> str | None:
    """Return the variable in which a function has all that it makes, an empty text where it is not one alone.

    None where it makes no action, or where one may be used elsewhere.
    """
    inside = [item for statement in function.body for item in ast.walk(statement)]
    if any(isinstance(item, _INNER) for item in inside):
        return None
    made = [item for item in inside if called_by(item) in ACTIONS]
    names = _holding(inside)
    harmless = {id(item) for statement in inside for item in _staying(statement, names)}
    loads = [
        item
        for item in inside
        if isinstance(item, ast.Name) and item.id in names and id(item) not in harmless
    ]
    used = [item for item in loads if isinstance(item.ctx, ast.Load)]
    if not made or used or any(id(item) not in harmless for item in made):
        return None
    lists = {name for name, is_list in names.items() if is_list}
    return lists.pop() if len(lists) == 1 else next(iter(names)) if len(names) == 1 else ""


def _holding(inside: list[ast.AST]) -> dict[str, bool]:
    """Return the variables that are set to actions, and the lists that such are added to: whether it is a list."""
    found: dict[str, bool] = {}
    for node in inside:
        match node:
            case (
                ast.Assign(targets=[ast.Name(id=name)], value=value)
                | ast.AnnAssign(target=ast.Name(id=name), value=ast.expr() as value)
            ):
                if called_by(value) in ACTIONS or (isinstance(value, ast.List) and _has(value, found)):
                    found[name] = isinstance(value, ast.List)
            case ast.AugAssign(target=ast.Name(id=name), op=ast.Add(), value=ast.List()):
                found[name] = True
            case ast.Expr(value=ast.Call(func=ast.Attribute(value=ast.Name(id=name), attr=attribute))):
                if attribute in _ADDING:
                    found[name] = True
    return {name: is_list for name, is_list in found.items() if _is_set_here(name, inside)}


def _is_set_here(name: str, inside: list[ast.AST]) -> bool:
    """Return whether a variable is one of the function's own, which it sets to an action or a list."""
    values = [
        node.value
        for node in inside
        if isinstance(node, ast.Assign | ast.AnnAssign)
        and any(isinstance(item, ast.Name) and item.id == name for item in _targets(node))
    ]
    is_shared = any(isinstance(node, ast.Global | ast.Nonlocal) and name in node.names for node in inside)
    kinds = (*ACTIONS, "LaunchDescription", "list")
    return (
        bool(values)
        and not is_shared
        and all(isinstance(value, ast.List) or called_by(value or ast.Pass()) in kinds for value in values)
    )


def _targets(node: ast.Assign | ast.AnnAssign) -> list[ast.expr]:
    return node.targets if isinstance(node, ast.Assign) else [node.target]


def _has(listed: ast.List, names: dict[str, bool]) -> bool:
    """Return whether a list holds an action that is made there, or has been made before."""
    return any(
        called_by(item) in ACTIONS or (isinstance(item, ast.Name) and item.id in names)
        for item in ast.walk(listed)
    )


def _staying(statement: ast.AST, names: dict[str, bool]) -> Iterator[ast.AST]:
    """Yield the names and the calls of a statement that go nowhere but to one of the function's own variables."""
    match statement:
        case (
            ast.Assign(targets=[ast.Name(id=name)], value=value)
            | ast.AnnAssign(target=ast.Name(id=name), value=ast.expr() as value)
        ) if name in names:
            yield from _parts(value)
        case ast.AugAssign(target=ast.Name(id=name), value=value) if name in names:
            yield from _parts(value)
        case ast.Expr(value=ast.Call(func=ast.Attribute(value=ast.Name(id=name) as held), args=given)) if (
            name in names and statement.value.func.attr in _ADDING  # type: ignore[attr-defined] # as matched
        ):
            yield held
            for item in given:
                yield from _parts(item)
        case ast.Expr(value=value) if called_by(value) in ACTIONS or isinstance(value, ast.List | ast.Name):
            yield from _parts(value)


def _parts(value: ast.expr) -> Iterator[ast.AST]:
    """Yield an action that is made, or the items of a list of such, and what they are given."""
    match value:
        case ast.Call(args=given, keywords=words) if called_by(value) in ACTIONS:
            yield value
            for item in (*given, *(word.value for word in words)):
                yield from _parts(item)
        case ast.List(elts=items) | ast.Tuple(elts=items):
            for item in items:
                yield from _parts(item)
        case ast.Call(args=given, keywords=words) if (called_by(value) or "")[:1].isupper():
            for item in (*given, *(word.value for word in words)):  # an event handler, a condition
                yield from _parts(item)
        case ast.Name():
            yield value
