"""The texts that code of launch files has of launch arguments, by performing a substitution, and what these may be."""

from __future__ import annotations

import ast
from functools import lru_cache
from typing import TYPE_CHECKING, Final, NamedTuple

from orchestra.compat.syntax_trees import called_by

if TYPE_CHECKING:
    from orchestra.compat.syntax_trees import Tree

_CHANGING: Final = frozenset({"casefold", "lower", "lstrip", "rstrip", "strip", "upper"})
_CONFIGURATIONS: Final = "launch_configurations"


class Known(NamedTuple):
    """What a file tells of a launch argument: the text that it has by default, and its choices, where it has any."""

    default: str | None
    choices: tuple[str, ...] | None


_UNKNOWN: Final = Known(None, None)


def performed(node: ast.expr, tree: Tree) -> str | None:
    """Return the launch argument whose text an expression is, an empty name for another text; None for no such text."""
    match tree.meaning(node):
        case ast.Call(func=ast.Attribute(value=inner, attr="perform"), args=[_]):
            return argument_of(inner, tree) or ""
        case ast.Call(func=ast.Attribute(attr="perform_substitution"), args=[inner]):
            return argument_of(inner, tree) or ""
        case ast.Call(func=ast.Name(id="perform_substitutions"), args=[_, _]):
            return ""
        case ast.Call(
            func=ast.Attribute(value=ast.Attribute(attr=held), attr="get"), args=[ast.Constant() as name, *_]
        ):
            return str(name.value) if held == _CONFIGURATIONS else None
        case ast.Subscript(value=ast.Attribute(attr=held), slice=ast.Constant() as name):
            return str(name.value) if held == _CONFIGURATIONS else None
        case ast.Call(func=ast.Attribute(value=inner, attr=changing), args=[]) if changing in _CHANGING:
            return performed(inner, tree)
        case ast.Call(func=ast.Name(id="str"), args=[inner]):
            return performed(inner, tree)
    return None


def is_changed(node: ast.expr, tree: Tree) -> bool:
    """Return whether the letters of a text are made large or small."""
    match tree.meaning(node):
        case ast.Call(func=ast.Attribute(value=inner, attr=changing), args=[]) if changing in _CHANGING:
            return "strip" not in changing or is_changed(inner, tree)
    return False


def argument_of(node: ast.expr, tree: Tree) -> str | None:
    """Return the launch argument of which an expression is the substitution."""
    made = tree.meaning(node)
    given = [*made.args, *(word.value for word in made.keywords)] if isinstance(made, ast.Call) else []
    if called_by(made) != "LaunchConfiguration" or not given:
        return None
    name = given[0]
    return name.value if isinstance(name, ast.Constant) and isinstance(name.value, str) else None


def known_of(name: str, tree: Tree) -> Known:
    """Return what a file tells of a launch argument."""
    return _known(tree).get(name, _UNKNOWN)


@lru_cache(maxsize=1)
def _known(tree: Tree) -> dict[str, Known]:
    """Return what a file tells of each of its launch arguments where it first does."""
    found: dict[str, Known] = {}
    for node in tree.nodes:
        if isinstance(node, ast.Call) and called_by(node) in ("DeclareLaunchArgument", "LaunchConfiguration"):
            words = {word.arg: word.value for word in node.keywords}
            of = node.args[0] if node.args else words.get("name") or words.get("variable_name")
            default = words.get("default_value") or words.get("default")
            is_told = default is not None or "choices" in words
            if is_told and isinstance(of, ast.Constant) and isinstance(of.value, str) and of.value:
                found.setdefault(of.value, Known(_text(default), _texts(words.get("choices"))))
    return found


def _text(node: ast.expr | None) -> str | None:
    match node:
        case ast.Constant(value=str(text)):
            return text
        case ast.Call(keywords=[ast.keyword(arg="text", value=ast.Constant(value=str(text)))]):
            return text
        case ast.List(elts=[only]):
            return _text(only)
    return None


def _texts(node: ast.expr | None) -> tuple[str, ...] | None:
    match node:
        case ast.List(elts=items) | ast.Tuple(elts=items):
            found = [
                item.value for item in items if isinstance(item, ast.Constant) and isinstance(item.value, str)
            ]
            return tuple(found) if found and len(found) == len(items) else None
    return None
