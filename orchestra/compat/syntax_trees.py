"""Syntax trees of the user's files: the expressions in them by place, and what their names stand for."""

from __future__ import annotations

import ast
import linecache
import warnings
from bisect import bisect_right
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.compat.place import is_own, span_in
from orchestra.compat.scopes import Function, names_set, of_scope, parameters, value_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import FrameType

    from orchestra.location import Span

_Range: TypeAlias = tuple[int, int, int, int]
_RAISED: Final = frozenset({"BaseException", "Exception", "RuntimeError", "TypeError", "ValueError"})

_MOST_TEXTS: Final = 16
_read_as: dict[str, Tree] = {}  # texts that are no Python
_of_file: dict[str, tuple[list[str], Tree | None]] = {}


class Tree:
    """The tree of one file."""

    def __init__(self, module: ast.Module) -> None:
        self.module = module
        self.nodes = [node for node in ast.walk(module) if isinstance(node, ast.expr | ast.stmt)]
        self._places: dict[tuple[str, int, int], dict[Span, ast.expr]] = {}
        self._setting: dict[Function | ast.Module, dict[str, list[ast.AST]]] = {}
        self._apart: dict[int, bool] = {}
        self._texts: dict[str, dict[str, Span]] = {}

    def is_apart(self, listed: ast.List | ast.Tuple | ast.Set) -> bool:
        """Return whether each item of a list is written there; each of thousands may be asked for."""
        known = self._apart.get(id(listed))
        if known is None:
            known = self._apart[id(listed)] = is_apart(listed)
        return known

    def expression(self, file: str, span: Span) -> ast.expr | None:
        """Return the expression at a place, None where there is none; that of a text is with its quotes or without."""
        lines = (span.line, span.end_line)
        known = self._places.get((file, *lines))
        if known is None:
            known = self._places[file, *lines] = {}
            for node in self._of_lines.get(lines, ()):
                for place in (node_span(file, node, quotes=True), node_span(file, node)):
                    known.setdefault(place, node)
        return known.get(span)

    @cached_property
    def _of_lines(self) -> dict[tuple[int, int | None], list[ast.expr]]:
        """The expressions by their first and last line."""
        found: dict[tuple[int, int | None], list[ast.expr]] = {}
        for node in self.nodes:
            if isinstance(node, ast.expr):
                found.setdefault((node.lineno, node.end_lineno), []).append(node)
        return found

    def texts(self, file: str) -> dict[str, Span]:
        """Return the texts that stand but once in the file, and where; each of thousands of problems asks for them."""
        known = self._texts.get(file)
        if known is None:
            found: dict[str, list[ast.Constant]] = {}
            for node in self.nodes:
                if isinstance(node, ast.Constant) and isinstance(node.value, str):
                    found.setdefault(node.value, []).append(node)
            once = {text: nodes[0] for text, nodes in found.items() if len(nodes) == 1}
            known = self._texts[file] = {text: node_span(file, node) for text, node in once.items()}
        return known

    def functions_around(self, node: ast.AST) -> Iterator[Function]:
        """Yield the functions that a node stands in, innermost first."""
        place = _range(node)
        begins, functions = self._functions
        last = bisect_right(begins, (place[0], place[2])) - 1
        while last >= 0:
            function, last_around = functions[last]
            if _holds(_range(function), place):
                yield function
            last = last_around

    @cached_property
    def _functions(self) -> tuple[list[tuple[int, int]], list[tuple[Function, int]]]:
        """Where functions begin, in order, and these with the number of the one that each stands in, else -1."""
        every = sorted((node for node in self.nodes if isinstance(node, Function)), key=_range)
        found: list[tuple[Function, int]] = []
        for function in every:
            around = len(found) - 1
            while around >= 0 and not _holds(_range(found[around][0]), _range(function)):
                around = found[around][1]
            found.append((function, around))
        return [(function.lineno, function.col_offset) for function in every], found

    def context_around(self, node: ast.AST) -> str | None:
        """Return what functions around a node call the launch context that they are given, None where none is."""
        given = (item.arg for around in self.functions_around(node) for item in around.args.args)
        return next((name for name in given if "context" in name or name == "ctx"), None)

    def declared(self) -> frozenset[str]:
        """Return the launch arguments that the file declares by names that are written there."""
        return self._declared

    @cached_property
    def _declared(self) -> frozenset[str]:
        return frozenset(self._declarations())

    def _declarations(self) -> Iterator[str]:
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
            for node in self._tries
        ) or self.catches(line)

    def catches(self, line: int) -> bool:
        """Return whether the code of a line is tried, and what our classes raise is dealt with by the code itself."""
        return any(
            node.body[0].lineno <= line <= (node.body[-1].end_lineno or 0) and any(map(_takes, node.handlers))
            for node in self._tries
        ) or any(
            node.lineno <= line <= (node.end_lineno or 0)
            and any("suppress" in ast.unparse(item) for item in node.items)
            for node in self._withs
        )

    @cached_property
    def _tries(self) -> list[ast.Try]:
        return [node for node in self.nodes if isinstance(node, ast.Try)]

    @cached_property
    def _withs(self) -> list[ast.With]:
        return [node for node in self.nodes if isinstance(node, ast.With)]

    def meaning(self, node: ast.expr) -> ast.expr:
        """Return the expression that a name stands for where it is set once, else the node itself.

        It is never part of that itself, as `mode` would be where a function begins with `mode = mode.lower()`: whoever
        asks for the meaning of each part comes to an end.
        """
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
            set_here = self.set_in(scope).get(name.id, ())
            if isinstance(scope, Function) and name.id in parameters(scope):
                return None
            if set_here:
                value = value_of(set_here[0], name.id) if len(set_here) == 1 else None
                innermost = next(self.functions_around(name), self.module)
                return value if scope is not innermost or _is_before(value, name) else None
        return None

    def set_in(self, scope: Function | ast.Module) -> dict[str, list[ast.AST]]:
        """Return what sets names in a scope, by these."""
        if scope not in self._setting:
            found = self._setting[scope] = {}
            for node in of_scope(scope):
                for name in set(names_set(node)):
                    found.setdefault(name, []).append(node)
        return self._setting[scope]


def tree_of(file: str) -> Tree | None:
    """Return the tree of a file, None where it has changed since it was run, or is none of Python."""
    lines = linecache.getlines(file)
    known = _of_file.get(file)
    if known is not None and known[0] is lines:
        return known[1]
    text = "".join(lines)
    tree = _tree(text) or _read_as.get(text)
    if len(_of_file) >= _MOST_TEXTS:
        _of_file.clear()
    _of_file[file] = (lines, tree)
    return tree


def read_as(text: str, module: ast.Module) -> None:
    """Let a text that is no Python have the tree of what was meant by it, in which places are those of the text."""
    if _tree(text) is None:
        if len(_read_as) >= _MOST_TEXTS:
            _read_as.clear()
        _read_as[text] = Tree(module)
        _of_file.clear()


def is_apart(listed: ast.List | ast.Tuple | ast.Set) -> bool:
    """Return whether each item of a list is written there, none spread into it."""
    return not any(isinstance(item, ast.Starred) for item in listed.elts)


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


def _is_before(value: ast.expr | None, name: ast.Name) -> bool:
    """Return whether a value ends before a name begins."""
    if value is None:
        return False
    ends, begins = _range(value), _range(name)
    return (ends[1], ends[3]) <= (begins[0], begins[2])


def _holds(outer: _Range, inner: _Range) -> bool:
    begins = (outer[0], outer[2]) <= (inner[0], inner[2])
    return begins and (inner[1], inner[3]) <= (outer[1], outer[3])


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
