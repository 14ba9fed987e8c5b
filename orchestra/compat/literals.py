"""Where the values of keywords stand in the user's code: in the literals of the call, as deep as they go."""

from __future__ import annotations

import ast
import linecache
from functools import lru_cache
from typing import TYPE_CHECKING

from orchestra.compat.place import span_in

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.place import Place
    from orchestra.location import Span


def keyword(place: Place, name: str) -> Literal:
    """Return where the value of a keyword of the call at a place stands; the whole call where it cannot be told."""
    call = call_at(place)
    found = None if call is None else next((item.value for item in call.keywords if item.arg == name), None)
    return Literal(place.file, found, place.span)


def call_at(place: Place) -> ast.Call | None:
    """Return the call at a place, None where there is none."""
    return _calls(place.file, _text(place.file)).get(place.span)


def item_span(place: Place, index: int, count: int) -> Span:
    """Return where an item stands of the list, of so many, that the call at a place takes; else the whole call."""
    call = call_at(place)
    arguments = [] if call is None else [*call.args, *(item.value for item in call.keywords)]
    lists = [node for node in arguments if isinstance(node, ast.List | ast.Tuple) and len(node.elts) == count]
    return Literal(place.file, lists[0] if lists else None, place.span).item(index, count).span


def argument_span(place: Place, text: str) -> Span | None:
    """Return where a text stands as an argument of the call at a place, None where it comes from elsewhere."""
    call = call_at(place)
    for node in () if call is None else (*call.args, *(item.value for item in call.keywords)):
        if isinstance(node, ast.Constant) and node.value == text:
            return _span(place.file, node)
    return None


def keyword_span(place: Place, keyword: ast.keyword) -> Span:
    """Return where the name of a keyword stands."""
    return _span(place.file, keyword)


class Literal:
    """An expression of the user's code, or what is around it where there is none of its own."""

    __slots__ = ("_file", "_node", "span")

    def __init__(self, file: str, node: ast.expr | None, around: Span) -> None:
        self._file = file
        self._node = node
        self.span = around if node is None else _span(file, node)

    def key(self, key: str) -> Span:
        """Return where a key of a dictionary stands."""
        found = self._entry(key)[0]
        return self.span if found is None else _span(self._file, found)

    def value(self, key: str) -> Literal:
        """Return where the value of a key stands."""
        return Literal(self._file, self._entry(key)[1], self.span)

    def item(self, index: int, count: int) -> Literal:
        """Return where an item of a list stands that has so many."""
        node = self._node
        items = node.elts if isinstance(node, ast.List | ast.Tuple | ast.Set) else []
        known = index < len(items) == count and not any(isinstance(item, ast.Starred) for item in items)
        return Literal(self._file, items[index] if known else None, self.span)

    def _entry(self, key: str) -> tuple[ast.expr | ast.keyword | None, ast.expr | None]:
        node = self._node
        if isinstance(node, ast.Dict):
            for written, value in zip(node.keys, node.values, strict=True):
                if isinstance(written, ast.Constant) and written.value == key:
                    return written, value
        if isinstance(node, ast.Call):  # dict(key=value)
            for item in node.keywords:
                if item.arg == key:
                    return item, item.value
        return None, None


def _span(file: str, node: ast.expr | ast.keyword) -> Span:
    """Return the place of an expression; of a text without its quotes, of a keyword without its value."""
    end_line, begin, end = node.end_lineno or node.lineno, node.col_offset, node.end_col_offset or 0
    if isinstance(node, ast.keyword):
        end_line, end = node.lineno, begin + len((node.arg or "").encode())
    elif isinstance(node, ast.Constant) and isinstance(node.value, str) and end_line == node.lineno:
        inside = len(node.value.encode("utf-8", "surrogatepass"))
        if end - begin == inside + 2:  # else it has escapes or a prefix
            begin, end = begin + 1, end - 1
    return span_in(file, (node.lineno, end_line, begin, end))


def _text(file: str) -> str:
    return "".join(linecache.getlines(file))


@lru_cache(maxsize=16)
def _calls(file: str, text: str) -> Mapping[Span, ast.Call]:
    """Return the calls in a file by their place."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError):  # it has changed since it was loaded
        return {}
    return {_span(file, node): node for node in ast.walk(tree) if isinstance(node, ast.Call)}
