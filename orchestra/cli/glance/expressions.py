"""Expressions of Python launch files that come to the same whatever is set, found in the text of the file."""

from __future__ import annotations

import ast
import os
from collections import Counter
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

    from orchestra.cli.glance.model import Places


class Expressions:
    """The names of one file, and what expressions with them come to."""

    def __init__(self, tree: ast.Module, places: Places) -> None:
        self._places = places
        nodes = list(ast.walk(tree))
        self._originals = dict(_renamed_imports(nodes))
        self._values = _assigned_once(nodes)
        self._bound: dict[str, ast.expr] = {}
        self._open: list[ast.expr] = []

    def original(self, name: str) -> str:
        """Return the name under which an imported thing was defined."""
        return self._originals.get(name, name)

    def named(self, node: ast.expr | None) -> ast.expr | None:
        """Return the expression behind a name that is assigned once, any other expression as it is."""
        seen: list[ast.expr] = []
        while isinstance(node, ast.Name | ast.Subscript) and node not in seen:
            seen.append(node)
            node = self._behind(node) or node
        return node

    def rounds(self, target: ast.expr, sequence: ast.expr) -> list[dict[str, ast.expr]] | None:
        """Return what each round of a loop over written-out elements binds, None for any other loop."""
        names = target.elts if isinstance(target, ast.Tuple) else [target]
        elements = self._elements(sequence)
        if elements is None or not all(isinstance(name, ast.Name) for name in names):
            return None
        rounds = []
        for element in elements:
            value = self.named(element)
            values = value.elts if isinstance(value, ast.Tuple | ast.List) else []
            found = values if isinstance(target, ast.Tuple) else [element]
            rounds.append(
                {name.id: one for name, one in zip(names, found, strict=False) if isinstance(name, ast.Name)}
            )
        return rounds

    @contextmanager
    def bound(self, values: Mapping[str, ast.expr]) -> Iterator[None]:
        """Let names stand for expressions for a while."""
        outer = self._bound
        self._bound = {**outer, **values}
        try:
            yield
        finally:
            self._bound = outer

    def text(self, node: ast.expr | None) -> str | None:
        """Return what an expression comes to as a text, None where that depends on anything."""
        match node:
            case ast.Constant(value=str() | bool() | int() | float() as value):
                return str(value)
            case ast.Name() | ast.Subscript():
                return self._text_behind(node)
            case ast.List(elts=elements) | ast.Tuple(elts=elements) | ast.JoinedStr(values=elements):
                return self._joined("", elements)
            case ast.FormattedValue(value=value, conversion=-1, format_spec=None):
                return self.text(value)
            case ast.BinOp(left=left, op=ast.Add() | ast.Div() as operator, right=right):
                return self._joined(os.sep if isinstance(operator, ast.Div) else "", [left, right])
            case ast.Attribute(value=value, attr="parent"):
                return _parent(self.text(value))
            case ast.Call():
                return self._call(node)
        return None

    def texts(self, node: ast.expr | None) -> tuple[str, ...] | None:
        """Return the texts of a list, None where one of them is unknown."""
        node = self.named(node)
        if not isinstance(node, ast.List | ast.Tuple):
            return None
        found = [self.text(element) for element in node.elts]
        return tuple(text for text in found if text is not None) if None not in found else None

    def keys(self, node: ast.expr | None) -> frozenset[str]:
        """Return the names in `{'a': x}`, `{'a': x}.items()`, `dict(a=x)` or `[('a', x)]` that are known."""
        node = self.named(node)
        if isinstance(node, ast.Call):
            if isinstance(node.func, ast.Attribute) and node.func.attr == "items":
                return self.keys(node.func.value)
            return frozenset(item.arg for item in node.keywords if item.arg)
        found: list[ast.expr | None] = []
        if isinstance(node, ast.Dict):
            found = list(node.keys)
        elif isinstance(node, ast.List | ast.Tuple):
            found = [item.elts[0] for item in node.elts if isinstance(item, ast.Tuple) and item.elts]
        texts = (self.text(key) for key in found)
        return frozenset(text for text in texts if text is not None)

    def _text_behind(self, node: ast.Name | ast.Subscript) -> str | None:
        found = self._behind(node)
        if found is None and isinstance(node, ast.Name) and node.id == "__file__":
            return self._places.path
        if found is None or found in self._open:
            return None
        self._open.append(found)
        try:
            return self.text(found)
        finally:
            self._open.pop()

    def _behind(self, node: ast.Name | ast.Subscript) -> ast.expr | None:
        """Return the value of a name, or of a key of a mapping that is written out."""
        if isinstance(node, ast.Name):
            return self._bound.get(node.id) or self._values.get(node.id)
        mapping = self.named(node.value)
        key = self.text(node.slice)
        if not isinstance(mapping, ast.Dict) or key is None:
            return None
        found = (
            value for name, value in zip(mapping.keys, mapping.values, strict=True) if self.text(name) == key
        )
        return next(found, None)

    def _elements(self, sequence: ast.expr) -> Sequence[ast.expr] | None:
        found = self.named(sequence)
        if (
            isinstance(found, ast.Call)
            and isinstance(found.func, ast.Attribute)
            and found.func.attr == "items"
        ):
            mapping = self.named(found.func.value)
            if isinstance(mapping, ast.Dict):
                pairs = zip(mapping.keys, mapping.values, strict=True)
                return [ast.Tuple([key, value]) for key, value in pairs if key is not None]
        return found.elts if isinstance(found, ast.List | ast.Tuple | ast.Set) else None

    def _joined(self, separator: str, elements: Sequence[ast.expr]) -> str | None:
        parts = []
        for element in elements:
            text = self.text(element)
            if text is None:
                return None
            parts.append(text)
        return separator.join(parts)

    def _call(self, call: ast.Call) -> str | None:
        name = self.original(callee(call))
        if name == "ThisLaunchFileDir":
            return _parent(self._places.path)
        if name in _METHODS and isinstance(call.func, ast.Attribute):
            return self.text(call.func.value)
        if name == "PathJoinSubstitution" and len(call.args) == 1:
            elements = self.named(call.args[0])
            return self._joined(os.sep, elements.elts) if isinstance(elements, ast.List | ast.Tuple) else None
        if name == "join" and _is_path_join(call):
            return self._joined(os.sep, call.args)
        text = self.text(call.args[0] if call.args else keyword(call, "text") or keyword(call, "package"))
        function = self._functions().get(name)
        return None if text is None or function is None else function(text)

    def _functions(self) -> dict[str, Callable[[str], str | None]]:
        share, prefix = self._places.share, self._places.prefix
        return {
            **dict.fromkeys(_SAME, lambda text: text),
            **dict.fromkeys(
                ("get_package_share_directory", "get_package_share_path", "FindPackageShare"), share
            ),
            **dict.fromkeys(("get_package_prefix", "FindPackagePrefix", "FindPackage"), prefix),
            "find": share,  # FindPackageShare('x').find('x')
            "dirname": _parent,
        }


# What changes nothing about a path: methods of one, and functions of a text.
_METHODS = frozenset({"resolve", "absolute", "as_posix"})
_SAME = frozenset({"str", "Path", "TextSubstitution", "PathSubstitution", "abspath", "realpath", "normpath"})


def callee(call: ast.Call) -> str:
    """Return the last word of what is called, an empty text where it has none."""
    if isinstance(call.func, ast.Attribute):
        return call.func.attr
    return call.func.id if isinstance(call.func, ast.Name) else ""


def keyword(call: ast.Call, name: str) -> ast.expr | None:
    """Return the value that a call gives under a keyword."""
    return next((item.value for item in call.keywords if item.arg == name), None)


def _is_path_join(call: ast.Call) -> bool:
    """Tell `os.path.join(...)` and `join(...)` from the method of a text."""
    return isinstance(call.func, ast.Name) or (
        isinstance(call.func, ast.Attribute) and isinstance(call.func.value, ast.Name | ast.Attribute)
    )


def _parent(path: str | None) -> str | None:
    return None if path is None else os.path.dirname(path)  # noqa: PTH120 - a text is wanted, and pathlib would change it


def _renamed_imports(nodes: Iterable[ast.AST]) -> Iterator[tuple[str, str]]:
    for node in nodes:
        if isinstance(node, ast.ImportFrom):
            for alias in node.names:
                if alias.asname:
                    yield alias.asname, alias.name


def _assigned_once(nodes: Sequence[ast.AST]) -> dict[str, ast.expr]:
    """Return the values of the names that one plain assignment sets, and nothing else in the file."""
    stores = Counter(
        node.arg if isinstance(node, ast.arg) else node.id
        for node in nodes
        if isinstance(node, ast.arg) or (isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store))
    )
    found = {}
    for node in nodes:
        if isinstance(node, ast.Assign) and len(node.targets) == 1:
            target, value = node.targets[0], node.value
        elif isinstance(node, ast.AnnAssign) and node.value is not None:
            target, value = node.target, node.value
        else:
            continue
        if isinstance(target, ast.Name) and stores[target.id] == 1:
            found[target.id] = value
    return found
