"""Functions of a loop that use what it goes through: they are called when it is done, and all see the last one."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.compat.rewritten import Rewritten
from orchestra.compat.scopes import Function
from orchestra.compat.syntax_trees import node_span
from orchestra.errors import Code
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problem, Problems
    from orchestra.location import Span

_Late: TypeAlias = ast.Lambda | Function
_CALLING: Final = ("function", "on_")  # arguments that functions are handed over to
_LAST: Final = "it is called when the loop is done: "


def tell_late_loops(path: str, tree: Tree, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of such functions in a file, at the first place where they use it."""
    for loop in tree.nodes:
        names, inside = _loop(loop)
        for late in _late(inside) if names else ():
            used = _used(late, names)
            if used is None:
                continue
            given = ast.unparse(late.args)
            meant = f"{used.id}={used.id}"
            is_plain = not (late.args.vararg or late.args.kwarg or late.args.kwonlyargs)
            message = f"{_LAST}'{used.id}' is the last one for all; a default keeps it: {given}, {meant}"
            span, code = node_span(path, used), None
            if isinstance(late, ast.Lambda) and is_plain:
                span = node_span(path, late)
                code = Rewritten(f"lambda {given}{', ' if given else ''}{meant}: {ast.unparse(late.body)}")
            problems.warning(Code.USER_CODE, message, Location(span, chain), suggestion=code)


def without_last_ones(problems: Iterable[Problem]) -> Callable[[Problem], Problem | None]:
    """Return what leaves out that nodes have one name, in a file where that comes of a loop."""
    files = {item.span.file for item in problems if item.span is not None and item.message.startswith(_LAST)}

    def kept(problem: Problem) -> Problem | None:
        is_there = problem.span is not None and problem.span.file in files
        return None if is_there and problem.code is Code.DUPLICATE_NODE else problem

    return kept


def _loop(node: ast.AST) -> tuple[set[str], list[ast.AST]]:
    """Return what a loop goes through by, and what it does."""
    match node:
        case ast.For(target=target, body=body):
            return _names(target), [item for item in body if not _ends(item)]
        case ast.ListComp(elt=made, generators=[part]) | ast.GeneratorExp(elt=made, generators=[part]):
            return _names(part.target), [made]
    return set(), []


def _ends(node: ast.stmt) -> bool:
    """Return whether what is made here is made once: the loop ends behind it, so that nothing changes any more."""
    if isinstance(node, ast.If) and not node.orelse:
        return isinstance(node.body[-1], ast.Break | ast.Return)
    return isinstance(node, ast.Return)


def _names(target: ast.expr) -> set[str]:
    return {item.id for item in ast.walk(target) if isinstance(item, ast.Name)}


def _late(inside: list[ast.AST]) -> Iterator[_Late]:
    """Yield the functions that are handed over to what calls them later, but for those of functions in the loop.

    These have a scope of their own, in which a name may be another.
    """
    nodes = [item for node in inside for item in _walked(node)]
    functions = {node.name: node for node in nodes if isinstance(node, Function)}
    for node in nodes:
        for word in node.keywords if isinstance(node, ast.Call) else ():
            if (word.arg or "").startswith(_CALLING):
                if isinstance(word.value, ast.Lambda):
                    yield word.value
                elif isinstance(word.value, ast.Name) and word.value.id in functions:
                    yield functions[word.value.id]


def _walked(node: ast.AST) -> Iterator[ast.AST]:
    """Yield what stands in a statement, without what stands in functions inside of it."""
    waiting = [node]
    while waiting:
        item = waiting.pop()
        yield item
        if not isinstance(item, Function | ast.Lambda):
            waiting += ast.iter_child_nodes(item)


def _used(late: _Late, names: set[str]) -> ast.Name | None:
    """Return where a function first uses one of some names, unless it has that of its own."""
    own = {item.arg for item in (*late.args.args, *late.args.kwonlyargs)}
    body = [late.body] if isinstance(late, ast.Lambda) else late.body
    found = [
        node
        for item in body
        for node in ast.walk(item)
        if isinstance(node, ast.Name) and node.id in names - own
    ]
    is_set = {node.id for node in found if not isinstance(node.ctx, ast.Load)}
    used = [node for node in found if node.id not in is_set]
    return min(used, key=lambda node: (node.lineno, node.col_offset), default=None)
