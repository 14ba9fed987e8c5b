"""Where functions of the user's code stand, and what they return."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.literals import Literal
from orchestra.compat.place import span_in
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import called_by, node_span, tree_of

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import CodeType

    from orchestra.compat.scopes import Function
    from orchestra.location import Span

_MOST: Final = 100  # characters: what is longer is read better in the message alone


def name_of(function: Any) -> Span | None:
    """Return where the name of a function stands, None where it is not written in a file."""
    found = found_in(function)
    if found is None:
        return None
    return span_of_name(found[0].co_filename, found[1])


def span_of_name(file: str, node: Function) -> Span:
    """Return where the name of a function stands."""
    asynchronous = isinstance(node, ast.AsyncFunctionDef)
    begin = node.col_offset + len("async def " if asynchronous else "def ")
    return span_in(file, (node.lineno, node.lineno, begin, begin + len(node.name.encode())))


def returned_by(function: Any, made: Any) -> Literal | None:
    """Return the expression of what a function returns; its name where it is not told by one alone."""
    found = found_in(function)
    if found is None:
        return None
    code, node = found
    file, tree = code.co_filename, tree_of(code.co_filename)
    around = name_of(function)
    if around is None:
        return None
    returns = [item for item in statements_of(node) if isinstance(item, ast.Return)]
    if made is None:
        last = _without_return(node) if not returns else None
        if last is not None:
            return Literal(file, last, around, tree)
        empty = [item for item in returns if item.value is None or _is_none(item.value)]
        return Literal(file, None, node_span(file, empty[0]) if len(empty) == 1 else around, tree)
    values = [item.value for item in returns if item.value is not None and not _is_none(item.value)]
    return Literal(file, values[0] if len(values) == 1 else None, around, tree)


def described_by(returned: Literal, made: Any) -> Rewritten | None:
    """Return the launch description of actions that are returned without one."""
    source = "" if returned.node is None else text_at(returned.file, returned.whole)
    if not source or "\n" in source or len(source) > _MOST:
        return None
    if made is None:
        return Rewritten(f"return {source}")
    if isinstance(made, list | tuple):
        return Rewritten(f"LaunchDescription({source})")
    return Rewritten(f"LaunchDescription([{source}])") if callable(getattr(made, "execute", None)) else None


def _without_return(function: Function) -> ast.expr | None:
    """Return the launch description with which a function ends, and which it does not return."""
    match function.body[-1]:
        case ast.Expr(value=ast.Name() as name):
            return name
        case ast.Expr(value=ast.Call(func=called) as call) if called_by(call) == "LaunchDescription":
            return called
    return None


def found_in(function: Any) -> tuple[CodeType, Function] | None:
    """Return the code of a function and what is written of it, None where that is in no file."""
    code = getattr(getattr(function, "__func__", function), "__code__", None)
    tree = None if code is None else tree_of(code.co_filename)
    if code is None or tree is None:
        return None
    node = tree.function(code.co_name, code.co_firstlineno)
    return None if node is None else (code, node)


def statements_of(function: Function) -> Iterator[ast.AST]:
    """Yield the statements of a function, without those of functions in it."""
    waiting: list[ast.AST] = list(function.body)
    while waiting:
        node = waiting.pop(0)
        yield node
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.expr):
            waiting.extend(ast.iter_child_nodes(node))


def _is_none(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and node.value is None
