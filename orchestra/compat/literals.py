"""Where the values of arguments stand in the user's code: in the literals of the call, as deep as they go."""

from __future__ import annotations

import ast
import inspect
import re
from typing import TYPE_CHECKING, Any

from orchestra.compat.place import Key, Letters, ValueOf
from orchestra.compat.source_text import part_in
from orchestra.compat.syntax_trees import Tree, is_apart, node_span, tree_of
from orchestra.location import Span

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.compat.place import Place, Way

_GAPS = re.compile(r"\{[^{}]*\}|%[sd]")  # where `format` and `%` put other texts
_LISTS = ("list", "tuple", "sorted", "set")
_Parameter = inspect.Parameter


def keyword(place: Place, name: str) -> Literal:
    """Return where the value of a keyword of the call at a place stands; the whole call where it cannot be told."""
    return argument(place, (name,))


def argument(place: Place, path: Sequence[Way]) -> Literal:
    """Return where an argument of the call at a place stands, or what it holds; else what is around that."""
    tree, call = tree_of(place.file), call_at(place)
    node = None if call is None or tree is None else _argument(call, str(path[0]), place, tree)
    found = Literal(place.file, node, place.span, tree)
    for step in path[1:] if node is not None else ():
        found = found.step(step)
    return found


def call_at(place: Place) -> ast.Call | None:
    """Return the call at a place, None where there is none."""
    tree = tree_of(place.file)
    found = None if tree is None else tree.expression(place.file, place.span)
    return found if isinstance(found, ast.Call) else None


def item_span(place: Place, index: int, count: int) -> Span:
    """Return where an item stands of the list, of so many, that the call at a place takes; else the whole call."""
    call, tree = call_at(place), tree_of(place.file)
    arguments = [] if call is None else [*call.args, *(item.value for item in call.keywords)]
    for node in arguments:
        listed = Literal(place.file, node, place.span, tree)
        if listed.holds(count):
            return listed.item(index, count).whole
    return place.span


def argument_span(place: Place, text: str) -> Span | None:
    """Return where a text stands as an argument of the call at a place, None where it comes from elsewhere."""
    call, tree = call_at(place), tree_of(place.file)
    for written in () if call is None else (*call.args, *(item.value for item in call.keywords)):
        node = written if tree is None else tree.meaning(written)
        if isinstance(node, ast.Constant) and node.value == text:
            return node_span(place.file, node)
    return None


def keyword_span(place: Place, name: str) -> Span | None:
    """Return where the name of a keyword stands, in the call or in the literal of a mapping that it spreads."""
    call, tree = call_at(place), tree_of(place.file)
    keywords = [] if call is None else call.keywords
    for item in keywords:
        if item.arg == name:
            return node_span(place.file, item)
    for item in keywords:
        if item.arg is None:
            found = Literal(place.file, item.value, place.span, tree).entry(name)[0]
            if found is not None:
                return node_span(place.file, found)
    return None


class Literal:
    """An expression of the user's code, or what is around it where there is none of its own."""

    __slots__ = ("_tree", "file", "node", "span")

    def __init__(self, file: str, node: ast.expr | None, around: Span, tree: Tree | None = None) -> None:
        self.file = file
        self._tree = tree
        self.node = node
        self.span = around if node is None else node_span(file, node)

    @property
    def whole(self) -> Span:
        """The place of the expression, of a text with its quotes."""
        return self.span if self.node is None else node_span(self.file, self.node, quotes=True)

    @property
    def texts(self) -> dict[str, Span]:
        """The texts of the expression and of those that its names stand for, and where each first stands."""
        found: dict[str, Span] = {}
        if self.node is not None and self._tree is not None:
            for text, around in _texts_in(self.node, self._tree):
                span = node_span(self.file, text) if around is None else _text_in(self.file, around, text)
                if span is not None:
                    found.setdefault(str(text.value), span)
                for piece in _GAPS.split(str(text.value)) if around is None else ():
                    place = part_in(self.file, span, piece) if span is not None else None
                    if place is not None:
                        found.setdefault(piece, place)
        return found

    def step(self, step: Way) -> Literal:
        """Return where the value of a key stands, or an item, or a key."""
        if isinstance(step, Letters):
            return Literal(self.file, None, self._letters(step), self._tree)
        if isinstance(step, str):
            return self.value(step)
        if isinstance(step, Key | ValueOf):
            pair = self._pair(step)
            found = None if pair is None else pair[isinstance(step, ValueOf)]
            if isinstance(found, ast.keyword):
                return Literal(self.file, None, node_span(self.file, found), self._tree)
            return self._inside(found)
        return self.item(step, None)

    def _letters(self, letters: Letters) -> Span:
        """Return where some letters of a text stand, else the text, else the whole."""
        span = self.texts.get(letters.text)
        if span is None:
            return self.span
        if span.line == span.end_line and span.end_column - span.column == len(letters.text):
            begin, end = span.column + letters.begin, span.column + letters.end
            return Span(span.file, span.line, begin, span.line, end)
        return part_in(self.file, span, letters.text[letters.begin : letters.end]) or span

    def key(self, key: str) -> Span:
        """Return where a key of a dictionary stands."""
        found = self.entry(key)[0]
        return self.span if found is None else node_span(self.file, found)

    def value(self, key: str) -> Literal:
        """Return where the value of a key stands; dots may lead to dictionaries inside of it."""
        found = self.entry(key)[1]
        if found is None:
            for begin, _, rest in _split(key):
                inner = self.entry(begin)[1]
                if inner is not None:
                    return self._inside(inner).value(rest)
        return self._inside(found)

    def item(self, index: int, count: int | None) -> Literal:
        """Return where an item of a list stands that has so many, or the value of the entry of a dictionary."""
        node = self._meaning()
        if isinstance(node, ast.ListComp | ast.GeneratorExp):
            return self._inside(node.elt)
        items = self._items()
        if items is None or (count is not None and len(items) != count):
            return self._inside(None)
        return self._inside(items[index] if index < len(items) else None)

    def holds(self, count: int) -> bool:
        """Return whether this is a list of so many items."""
        node = self._meaning()
        return isinstance(node, ast.List | ast.Tuple) and len(self._items() or ()) == count

    def entry(self, key: str) -> tuple[ast.expr | ast.keyword | None, ast.expr | None]:
        """Return key and value of an entry of a dictionary, None for what is not written there."""
        node = self._meaning()
        if isinstance(node, ast.Dict):
            for written, value in zip(node.keys, node.values, strict=True):
                if isinstance(written, ast.Constant) and written.value == key:
                    return written, value
        if isinstance(node, ast.Call):  # dict(key=value)
            for item in node.keywords:
                if item.arg == key:
                    return item, item.value
        pairs = node.elts if isinstance(node, ast.List | ast.Tuple) else []
        for first, value in map(_sides, pairs):
            if isinstance(first, ast.Constant) and first.value == key:
                return first, value
        return None, None

    def _pair(self, index: int) -> tuple[ast.expr | ast.keyword | None, ast.expr] | None:
        """Return name and value of the entry of a number, None where they are not written there."""
        node = self._meaning()
        if isinstance(node, ast.Call):  # dict(key=value)
            return (node.keywords[index], node.keywords[index].value) if index < len(node.keywords) else None
        items = self._items() or ()
        if index >= len(items):
            return None
        if isinstance(node, ast.Dict):
            return node.keys[index], node.values[index]
        return _sides(items[index])

    def _inside(self, node: ast.expr | None) -> Literal:
        return Literal(self.file, node, self.span, self._tree)

    def _meaning(self) -> ast.expr | None:
        """Return the literal that the expression comes to, as far as that is written somewhere."""
        node = self.node
        while node is not None:
            known = node if self._tree is None else self._tree.meaning(node)
            match known:
                case ast.Call(func=ast.Attribute(value=inner, attr="items" | "copy"), args=[]):
                    node = inner
                case ast.Call(func=ast.Name(id=name), args=[inner], keywords=[]) if name in (*_LISTS, "dict"):
                    node = inner
                case _:
                    return known
        return None

    def _items(self) -> Sequence[ast.expr] | None:
        """Return the items of a list, the values of a dictionary; None where they cannot be told apart."""
        node = self._meaning()
        match node:
            case ast.Dict(values=values):
                return None if None in node.keys else values
            case ast.List(elts=items) | ast.Tuple(elts=items) | ast.Set(elts=items):
                apart = is_apart(node) if self._tree is None else self._tree.is_apart(node)
                return items if apart else None
            case ast.Call(func=ast.Name(id="dict"), args=[], keywords=words):
                return [word.value for word in words] if all(word.arg for word in words) else None
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                parts = self._inside(left)._items(), self._inside(right)._items()
                return None if parts[0] is None or parts[1] is None else [*parts[0], *parts[1]]
        return None


def _text_in(file: str, around: ast.JoinedStr, text: ast.Constant) -> Span | None:
    """Return where a text stands in an f-string, None where escapes hide it: up to 3.11 it has no place of its own."""
    return part_in(file, node_span(file, around), str(text.value))


def _texts_in(node: ast.AST, tree: Tree) -> Iterator[tuple[ast.Constant, ast.JoinedStr | None]]:
    """Yield the texts of an expression, and of those that its names stand for; with the f-string around each."""
    seen: set[int] = set()
    waiting: list[tuple[ast.AST, ast.JoinedStr | None]] = [(node, None)]
    while waiting:
        found, around = waiting.pop(0)
        if isinstance(found, ast.Name):
            found = tree.meaning(found)
        if id(found) in seen:
            continue
        seen.add(id(found))
        if isinstance(found, ast.Constant) and isinstance(found.value, str):
            yield found, around
        if not isinstance(found, ast.FormattedValue):
            inside = found if isinstance(found, ast.JoinedStr) else None
            waiting.extend((child, inside) for child in ast.iter_child_nodes(found))


def _sides(pair: ast.expr) -> tuple[ast.expr, ast.expr]:
    """Return the two expressions of a pair; of anything else the whole twice."""
    match pair:
        case ast.Tuple(elts=[name, value]) | ast.List(elts=[name, value]):
            return name, value
    return pair, pair


def _split(key: str) -> Iterator[tuple[str, str, str]]:
    """Yield the ways to split a key at a dot."""
    for index, character in enumerate(key):
        if character == ".":
            yield key[:index], ".", key[index + 1 :]


def _argument(call: ast.Call, name: str, place: Place, tree: Tree) -> ast.expr | None:
    """Return the expression of an argument: by its keyword, in a mapping that is spread, or by its position."""
    if name.startswith("*"):
        return call.args[int(name[1:])] if int(name[1:]) < len(call.args) else None
    for item in call.keywords:
        if item.arg == name:
            return item.value
    for item in call.keywords:
        if item.arg is None:
            found = Literal(place.file, item.value, place.span, tree).entry(name)[1]
            if found is not None:
                return found
    index = None if place.kind is None else position(place.kind, name)
    known = index is not None and not any(isinstance(item, ast.Starred) for item in call.args[: index + 1])
    return call.args[index] if known and index is not None and index < len(call.args) else None


def position(kind: type[Any], name: str) -> int | None:
    """Return the position of an argument of a class, None where it has none."""
    parameters = list(inspect.signature(kind.__init__).parameters.values())[1:]
    by_place = [item.name for item in parameters if item.kind is _Parameter.POSITIONAL_OR_KEYWORD]
    return by_place.index(name) if name in by_place else None
