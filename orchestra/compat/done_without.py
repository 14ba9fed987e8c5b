"""Failures that follow from what is not here, where code has caught that itself and goes no further without it.

So a file that imports xacro in a `try` is told what one is told that just imports it: on another machine it works.
"""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from orchestra.compat import missing_packages, unknown_names
from orchestra.compat.ament_index_python.packages import PackageNotFoundError
from orchestra.compat.asked import kept
from orchestra.compat.place import Place
from orchestra.compat.syntax_trees import tree_of
from orchestra.errors import Severity
from orchestra.fields import replace
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from types import TracebackType
    from typing import TypeGuard

    from orchestra.compat.asked import Asked
    from orchestra.compat.explanation import Explanation
    from orchestra.compat.syntax_trees import Tree

_UNBOUND = pattern(r"(?:variable|name) '(\w+)'")


def explained(error: BaseException, calls: Sequence[TracebackType], told: str) -> Explanation | None:
    """Explain a failure for want of something that another machine may have; None for any other.

    `calls` are the lines of users on the way to it, outermost first, and `told` is what Python says of it.
    """
    if isinstance(error, ModuleNotFoundError | PackageNotFoundError):
        return None
    at = Place(calls[-1].tb_frame.f_code, calls[-1].tb_lasti)
    for asked in (asked for call in calls for asked in kept(call.tb_frame.f_globals)):
        tree = tree_of(asked.place.file)
        tries = [] if tree is None else _tries(tree, asked.place.span.line)
        if any(_follows(error, calls[-1], at, asked, tried) for tried in tries):
            found = _meaning(asked)
            if found is not None and found.severity is not Severity.ERROR:
                note = f"the code has caught that, and goes no further at {at.span}: {told}"
                return replace(found, notes=(*found.notes, note))
    return None


def _meaning(asked: Asked) -> Explanation | None:
    """Return what is told where code does not catch it."""
    if isinstance(asked.error, PackageNotFoundError):
        return missing_packages.explained(asked.error, asked.place)
    return (
        unknown_names.not_in_module(asked.error, asked.place)
        if isinstance(asked.error, ImportError)
        else None
    )


def _tries(tree: Tree, line: int) -> list[ast.stmt]:
    """Return what tries the code of a line, or only asks whether something is here.

    Where nothing does, it is in a function that is tried: then all that is tried in the file.
    """
    tries = [node for node in tree.nodes if _is_tried(node)]
    found = [node for node in tries if node.body[0].lineno <= line <= (node.body[-1].end_lineno or 0)]
    asking = [node for node in _of(tree, ast.Assign, ast.If) if _holds(getattr(node, "test", node), line)]
    return [*found] if found else [*asking, *tries]


def _is_tried(node: ast.AST) -> TypeGuard[ast.Try | ast.With]:
    if isinstance(node, ast.With):
        return any("suppress" in ast.unparse(item) for item in node.items)
    return isinstance(node, ast.Try) and bool(node.handlers)


def _follows(error: BaseException, call: TracebackType, at: Place, asked: Asked, tried: ast.stmt) -> bool:
    """Return whether a failure is for want of what was tried to have.

    A name is not bound, there is None instead, or the code refuses to go on: where it has caught that, in the same
    function, or because of what it has noted there.
    """
    if isinstance(error, NameError):
        match = _UNBOUND.search(str(error))
        return match is not None and at.file == asked.place.file and match[1] in _bound(tried)
    if isinstance(error, AttributeError | TypeError) and "NoneType" in str(error):
        return True
    tree = tree_of(at.file)
    if call.tb_next is not None or tree is None or at.file != asked.place.file:
        return False
    line = at.span.line
    refuses = isinstance(error, SystemExit) or any(_holds(node, line) for node in _of(tree, ast.Raise))
    return refuses and (
        _holds(tried, line)
        or any(_holds(node, line) and _holds(node, tried.lineno) for node in _of(tree, ast.FunctionDef))
        or any(_holds(node, line) and _named(node) & _bound(tried) for node in _of(tree, ast.If))
    )


def _bound(tried: ast.stmt) -> set[str]:
    """Return the names that are bound where something is tried, in whatever way it ends."""
    found = set()
    for node in ast.walk(tried):
        if isinstance(node, ast.alias):
            found.add((node.asname or node.name).partition(".")[0])
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            found.add(node.id)
    return found


def _named(node: ast.stmt) -> set[str]:
    """Return the names that a condition asks for."""
    asked = ast.walk(node.test) if isinstance(node, ast.If) else ()
    return {name.id for name in asked if isinstance(name, ast.Name)}


def _of(tree: Tree, *kinds: type[ast.stmt]) -> Iterator[ast.stmt]:
    return (node for node in tree.nodes if isinstance(node, kinds))


def _holds(node: ast.stmt | ast.expr, line: int) -> bool:
    return node.lineno <= line <= (node.end_lineno or 0)
