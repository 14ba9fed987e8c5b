"""The calls of functions and classes that stand by their names alone, with what they surely are to be given."""

from __future__ import annotations

import ast
from inspect import Parameter, iscoroutinefunction, signature
from types import BuiltinFunctionType, FunctionType, MethodType
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.syntax_trees import called_by

if TYPE_CHECKING:
    from orchestra.compat.syntax_trees import Tree

CALLED: Final = (BuiltinFunctionType, FunctionType, MethodType, type)
_OF_PACKAGES: Final = frozenset(
    {
        *("FindPackage", "FindPackagePrefix", "FindPackageShare"),
        *("get_package_prefix", "get_package_share_directory", "get_package_share_path"),
    }
)
_OPEN: Final = (Parameter.VAR_KEYWORD, Parameter.VAR_POSITIONAL)


def call_of(source: str, value: Any, tree: Tree | None) -> str | None:
    """Return the call of a function or a class that stands by its name; None where it is not known with what."""
    if not isinstance(value, CALLED) or not source.replace(".", "").replace("_", "a").isidentifier():
        return None
    if iscoroutinefunction(value):
        return None
    if not _needs(value):
        return f"{source}()"
    given = None if tree is None else _package(source, tree)
    is_of_package = source.rpartition(".")[2] in _OF_PACKAGES
    return f"{source}({given})" if is_of_package and given is not None else None


def _needs(called: Any) -> bool:
    """Return whether something cannot be called without arguments."""
    try:
        given = signature(called).parameters.values()
    except (TypeError, ValueError):
        return False  # methods of texts and files
    return any(item.default is item.empty and item.kind not in _OPEN for item in given)


def _package(source: str, tree: Tree) -> str | None:
    """Return the package that a file surely means, as its other calls have it, or the nodes in it."""
    calls = [node for node in tree.nodes if isinstance(node, ast.Call)]
    for known in ({source.rpartition(".")[2]}, _OF_PACKAGES):
        given = {ast.unparse(node.args[0]) for node in calls if node.args and called_by(node) in known}
        if given:
            return given.pop() if len(given) == 1 else None
    words = (word for node in calls for word in node.keywords if word.arg == "package")
    named = {ast.unparse(word.value) for word in words}
    return named.pop() if len(named) == 1 else None
