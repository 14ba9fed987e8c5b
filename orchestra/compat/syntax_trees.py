"""Syntax trees of the user's files: the expressions in them by place, and what their names stand for."""

from __future__ import annotations

import ast
import linecache
import warnings
from functools import lru_cache
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.compat.place import is_own, span_in

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import FrameType

    from orchestra.location import Span

Function: TypeAlias = ast.FunctionDef | ast.AsyncFunctionDef
_Range: TypeAlias = tuple[int, int, int, int]
_RAISED: Final = frozenset({"BaseException", "Exception", "RuntimeError", "TypeError", "ValueError"})


class Tree:
    """The tree of one file."""

    def __init__(self, module: ast.Module) -> None:
        self.module = module
        self.nodes = [node for node in ast.walk(module) if isinstance(node, ast.expr | ast.stmt)]

    def expression(self, file: str, span: Span) -> ast.expr | None:
        """Return the expression at a place, None where there is none; that of a text is with its quotes or without."""
        for node in self.nodes:
            begins = (node.lineno, node.end_lineno) == (span.line, span.end_line)
            if not begins or not isinstance(node, ast.expr):
                continue
            if span in (node_span(file, node, quotes=True), node_span(file, node)):
                return node
        return None

    def texts(self, file: str) -> dict[str, Span]:
        """Return the texts that stand but once in the file, and where."""
        found: dict[str, list[ast.Constant]] = {}
        for node in self.nodes:
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                found.setdefault(node.value, []).append(node)
        return {text: node_span(file, nodes[0]) for text, nodes in found.items() if len(nodes) == 1}

    def functions_around(self, node: ast.AST) -> Iterator[Function]:
        """Yield the functions that a node stands in, innermost first."""
        place = _range(node)
        around = [item for item in self.nodes if isinstance(item, Function) and _holds(_range(item), place)]
        yield from sorted(around, key=_range, reverse=True)

    def context_around(self, node: ast.AST) -> str | None:
        """Return what functions around a node call the launch context that they are given, None where none is."""
        given = (item.arg for around in self.functions_around(node) for item in around.args.args)
        return next((name for name in given if "context" in name or name == "ctx"), None)

    def declared(self) -> Iterator[str]:
        """Yield the launch arguments that the file declares by names that are written there."""
        for node in self.nodes:
            match node:
                case ast.Call(args=[ast.Constant(value=str(name)), *_]) if (
                    called_by(node) == "DeclareLaunchArgument"
                ):
                    yield name
                case ast.Call(keywords=words) if called_by(node) == "DeclareLaunchArgument":
                    yield from (
                        str(word.value.value)
                        for word in words
                        if word.arg == "name" and isinstance(word.value, ast.Constant)
                    )

    def function(self, name: str, line: int) -> Function | None:
        """Return a function by its name, and the line where it or its first decorator stands."""
        for node in self.nodes:
            if isinstance(node, Function) and node.name == name:
                lines = (node.lineno, *(item.lineno for item in node.decorator_list))
                if line in lines:
                    return node
        return None

    def tries(self, line: int) -> bool:
        """Return whether the code of a line is tried, whatever the code itself deals with."""
        return any(
            node.body[0].lineno <= line <= (node.body[-1].end_lineno or 0) and node.handlers
            for node in self.nodes
            if isinstance(node, ast.Try)
        ) or self.catches(line)

    def catches(self, line: int) -> bool:
        """Return whether the code of a line is tried, and what our classes raise is dealt with by the code itself."""
        return any(
            node.body[0].lineno <= line <= (node.body[-1].end_lineno or 0) and any(map(_takes, node.handlers))
            for node in self.nodes
            if isinstance(node, ast.Try)
        ) or any(
            node.lineno <= line <= (node.end_lineno or 0)
            and any("suppress" in ast.unparse(item) for item in node.items)
            for node in self.nodes
            if isinstance(node, ast.With)
        )

    def meaning(self, node: ast.expr) -> ast.expr:
        """Return the expression that a name stands for where it is set once, else the node itself."""
        seen: set[str] = set()
        while isinstance(node, ast.Name) and node.id not in seen:
            seen.add(node.id)
            value = self._assigned(node)
            if value is None:
                break
            node = value
        return node

    def _assigned(self, name: ast.Name) -> ast.expr | None:
        """Return what is assigned to a name in the innermost scope that sets it, None unless that is done once."""
        for scope in (*self.functions_around(name), self.module):
            set_here = [node for node in _of_scope(scope) if _sets(node, name.id)]
            if isinstance(scope, Function) and name.id in _parameters(scope):
                return None
            if set_here:
                return _value_of(set_here[0], name.id) if len(set_here) == 1 else None
        return None


def tree_of(file: str) -> Tree | None:
    """Return the tree of a file, None where it has changed since it was run, or is none of Python."""
    return _tree("".join(linecache.getlines(file)))


def node_span(file: str, node: ast.expr | ast.stmt | ast.keyword, *, quotes: bool = False) -> Span:
    """Return the place of an expression; of a text without its quotes, of a keyword without its value."""
    end_line, begin, end = node.end_lineno or node.lineno, node.col_offset, node.end_col_offset or 0
    if isinstance(node, ast.keyword):
        end_line, end = node.lineno, begin + len((node.arg or "").encode())
    elif not quotes and isinstance(node, ast.Constant) and isinstance(node.value, str):
        inside = len(node.value.encode("utf-8", "surrogatepass"))
        if end_line == node.lineno and end - begin == inside + 2:  # else it has escapes or a prefix
            begin, end = begin + 1, end - 1
    return span_in(file, (node.lineno, end_line, begin, end))


@lru_cache(maxsize=16)
def _tree(text: str) -> Tree | None:
    try:
        with warnings.catch_warnings(action="ignore"):  # told when the file was run
            return Tree(ast.parse(text))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def _takes(handler: ast.ExceptHandler) -> bool:
    """Return whether a handler is for what wrong arguments raise."""
    return handler.type is None or any(
        isinstance(node, ast.Name) and node.id in _RAISED for node in ast.walk(handler.type)
    )


def _range(node: ast.AST) -> _Range:
    """Return first line, end line, first and end column in bytes."""
    line: int = getattr(node, "lineno", 1)
    return (
        line,
        getattr(node, "end_lineno", line),
        getattr(node, "col_offset", 0),
        getattr(node, "end_col_offset", 0),
    )


def _holds(outer: _Range, inner: _Range) -> bool:
    begins = (outer[0], outer[2]) <= (inner[0], inner[2])
    return begins and (inner[1], inner[3]) <= (outer[1], outer[3])


def _of_scope(scope: Function | ast.Module) -> Iterator[ast.AST]:
    """Yield what stands in a scope, without what is in functions and classes inside of it."""
    waiting: list[ast.AST] = list(scope.body)
    while waiting:
        node = waiting.pop(0)
        yield node
        if not isinstance(node, Function | ast.ClassDef | ast.Lambda):
            waiting.extend(ast.iter_child_nodes(node))


def _sets(node: ast.AST, name: str) -> bool:
    if isinstance(node, Function | ast.ClassDef):
        return node.name == name
    if isinstance(node, ast.Import | ast.ImportFrom):
        return any((item.asname or item.name) == name for item in node.names)
    targets = _targets(node)
    return any(
        isinstance(item, ast.Name) and item.id == name for target in targets for item in ast.walk(target)
    )


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


def _value_of(node: ast.AST, name: str) -> ast.expr | None:
    match node:
        case ast.Assign(targets=[ast.Name(id=found)], value=value) if found == name:
            return value
        case ast.AnnAssign(target=ast.Name(id=found), value=value) if found == name:
            return value
    return None


def _parameters(function: Function) -> set[str]:
    given = function.args
    every = (*given.posonlyargs, *given.args, *given.kwonlyargs, given.vararg, given.kwarg)
    return {item.arg for item in every if item is not None}


def called_by(node: ast.AST) -> str | None:
    """Return the name of what a call calls, without its module; None for what is no call."""
    match node:
        case ast.Call(func=ast.Name(id=name)) | ast.Call(func=ast.Attribute(attr=name)):
            return name
    return None


def is_dealt_with(frame: FrameType, deals: Callable[[Tree, int], bool]) -> bool:
    """Return whether a line of user code on the way to a frame deals with what is raised there.

    The way ends where our own code has called it.
    """
    around: FrameType | None = frame
    while around is not None and not is_own(around.f_code.co_filename):
        tree = tree_of(around.f_code.co_filename)
        if tree is not None and deals(tree, around.f_lineno):
            return True
        around = around.f_back
    return False
