"""What changes a list, a dictionary or a launch description and returns nothing, where code takes what it returns."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Final

from orchestra.compat.rewritten import Rewritten
from orchestra.compat.scopes import Function, parameters, value_of
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import called_by, node_span
from orchestra.errors import Code, Severity
from orchestra.fields import replace
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problem, Problems
    from orchestra.location import Span

_OF_LISTS: Final = frozenset({"append", "extend", "insert", "reverse", "sort"})
_OF_DICTIONARIES: Final = frozenset({"update"})
_OF_DESCRIPTIONS: Final = frozenset({"add_action", "add_entity"})
_TOLD: Final = " returns nothing: it changes what stands before it"
_MOST: Final = 100


def tell_returning_none(path: str, tree: Tree, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Report such calls in a file."""
    for node in tree.nodes:
        for call in _taken(node):
            method = _changing(call, tree)
            if method is None:
                continue
            span = node_span(path, call)
            meant = _meant(call, path)
            message = f"{method}{_TOLD}"
            problems.warning(Code.USER_CODE, message, Location(span, chain), suggestion=meant)


def without_nothings(problems: Iterable[Problem]) -> Callable[[Problem], Problem | None]:
    """Return what leaves out the problems that such a call leads to in its file."""
    files = {item.span.file for item in problems if item.span is not None and _TOLD in item.message}
    led_to = [item for item in problems if files and _is_led_to(item, files)]
    grave = {item.span.file for item in led_to if item.span and item.severity is Severity.ERROR}

    def kept(problem: Problem) -> Problem | None:
        if _is_led_to(problem, files):
            return None
        is_grave = problem.span is not None and problem.span.file in grave and _TOLD in problem.message
        return replace(problem, severity=Severity.ERROR) if is_grave else problem

    return kept


def _is_led_to(problem: Problem, files: set[str]) -> bool:
    is_there = problem.span is not None and problem.span.file in files and _TOLD not in problem.message
    return is_there and ("None" in problem.message or "returns nothing" in problem.message)


def _taken(node: ast.AST) -> Iterator[ast.Call]:
    """Yield the calls whose values are taken."""
    given: list[ast.expr | None] = []
    match node:
        case ast.Assign(value=value) | ast.Return(value=value):
            given = [value]
        case ast.Call(args=items, keywords=words):
            given = [*items, *(word.value for word in words)]
        case ast.List(elts=items) | ast.Tuple(elts=items):
            given = list(items)
    yield from (item for item in given if isinstance(item, ast.Call))


def _changing(call: ast.Call, tree: Tree) -> str | None:
    """Return the method that a call calls if that surely returns nothing."""
    if not isinstance(call.func, ast.Attribute):
        return None
    method, held = call.func.attr, _held(call.func.value, tree)
    is_one = (
        (method in _OF_LISTS and isinstance(held, ast.List | ast.ListComp))
        or (method in _OF_DICTIONARIES and isinstance(held, ast.Dict))
        or (method in _OF_DESCRIPTIONS and called_by(held) == "LaunchDescription")
    )
    return method if is_one else None


def _held(node: ast.expr, tree: Tree) -> ast.expr:
    """Return what something is first set to, which may be set again to what such a call returns."""
    known = tree.meaning(node)
    if not isinstance(known, ast.Name):
        return known
    for scope in (*tree.functions_around(known), tree.module):
        if isinstance(scope, Function) and known.id in parameters(scope):
            return known
        for item in tree.set_in(scope).get(known.id, ()):
            value = value_of(item, known.id)
            if value is not None:
                return value
    return known


def _meant(call: ast.Call, path: str) -> str | None:
    """Return an expression that has the value that was meant."""
    if not isinstance(call.func, ast.Attribute) or len(call.args) != 1 or call.keywords:
        is_sorted = isinstance(call.func, ast.Attribute) and call.func.attr == "sort" and not call.args
        held = call.func.value if isinstance(call.func, ast.Attribute) else call
        return Rewritten(f"sorted({ast.unparse(held)})") if is_sorted and not call.keywords else None
    receiver, given = (
        text_at(path, node_span(path, item, quotes=True)) for item in (call.func.value, call.args[0])
    )
    forms = {
        "append": f"[*{receiver}, {given}]",
        "extend": f"{receiver} + {given}",
        "update": f"{receiver} | {given}",
    }
    meant = forms.get(call.func.attr)
    if (
        call.func.attr in _OF_DESCRIPTIONS
        and isinstance(call.func.value, ast.Call)
        and not call.func.value.args
    ):
        meant = f"LaunchDescription([{given}])"
    return Rewritten(meant) if meant is not None and len(meant) <= _MOST and "\n" not in meant else None
