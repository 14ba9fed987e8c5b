"""Names that are not there: the one that was meant, and where a name of the launch language is to be had."""

from __future__ import annotations

import builtins
import re
import sys
from pathlib import Path
from pkgutil import iter_modules
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.borrowed import ROOM
from orchestra.compat.explanation import Explanation
from orchestra.compat.rewritten import Rewritten, arguments_around, in_quotes
from orchestra.compat.seam import connection
from orchestra.compat.source_text import text_at, word_in
from orchestra.compat.syntax_trees import node_span, tree_of
from orchestra.compat.whereabouts import class_meant, exporting, importing, package_meant
from orchestra.errors import HERE
from orchestra.nearest import is_one_slip, is_slip, nearest

if TYPE_CHECKING:
    from collections.abc import Iterable
    from types import FrameType, ModuleType

    from orchestra.compat.place import Place

_BESIDE: Final = (
    "it is beside the launch file, where Python does not look: sys.path.insert(0, os.path.dirname(__file__))"
)
_NOTHING: Final = frozenset({"NULL", "Null", "nil", "null", "none", "undefined"})
# What others call it that something is added to a launch description.
_ADDING: Final = frozenset({"add", "addAction", "add_node", "append", "extend"})
# What the interpreter adds for people at its prompt.
_OF_THE_PROMPT: Final = frozenset({"copyright", "credits", "exit", "help", "license", "quit"})
_IMPORTED: Final = re.compile(r"cannot import name '(\w+)'")


def unbound(error: NameError, frame: FrameType, place: Place) -> Explanation | None:
    """Explain a name that nobody has defined or imported."""
    if not error.name:
        return None
    message = f"there is no name '{error.name}' here"
    if error.name in _NOTHING:
        return Explanation(message, span=place.span, suggestion=Rewritten("None"))
    meant = None if exporting(error.name) else _meant(error.name, frame, place)
    if meant is not None and is_slip(error.name, meant) and meant.islower() == error.name.islower():
        return Explanation(message, span=place.span, suggestion=meant)
    instead = importing(error.name) or class_meant(error.name) or in_quotes(place, error.name) or meant
    notes = () if instead is None else _imports(instead)
    return Explanation(message, span=place.span, suggestion=instead, notes=notes)


def _imports(name: str) -> tuple[str, ...]:
    """Return that a class has to be imported, where it is one of the launch language."""
    return tuple(f"to have it, write: from {package} import {name}" for package in exporting(name)[:1])


def _meant(name: str, frame: FrameType, place: Place) -> str | None:
    """Return the name that was meant: one of the user's own, or one of Python's that this is a slip for."""
    around = arguments_around(place)
    own = nearest(name, _public({*frame.f_locals, *around})) or nearest(name, _public(frame.f_globals))
    known = nearest(name, _public(vars(builtins).keys() - _OF_THE_PROMPT))
    return own if own is not None or known is None or not is_slip(name, known) else known


def not_in_module(error: ImportError, place: Place) -> Explanation | None:
    """Explain a name that a module does not have; a module that is not there is explained too."""
    if isinstance(error, ModuleNotFoundError):
        return _no_module(error.name or "", place)
    match = _IMPORTED.search(str(error))
    module = sys.modules.get(error.name or "")
    return None if match is None or module is None else _no_name(match[1], module, place)


def no_attribute(error: AttributeError, place: Place) -> Explanation | None:
    """Explain an attribute that an object does not have."""
    if not error.name or (error.obj is None and "'NoneType'" not in str(error)):
        return None
    if isinstance(error.obj, type(sys)):
        return _no_name(error.name, error.obj, place)
    items = _without_items(error, place) if error.name == "items" else None
    if items is not None:
        return items
    meant = nearest(error.name, _public(dir(error.obj)))
    if error.name in _ADDING and hasattr(error.obj, "add_action"):
        meant = "add_action"
    kind = error.obj.__name__ if isinstance(error.obj, type) else type(error.obj).__name__
    kind = "None" if error.obj is None else kind
    message = f"{kind} has no attribute '{error.name}'"
    span = word_in(place.file, place.span, error.name)
    is_meant = meant is not None and (is_slip(error.name, meant) or error.name in _ADDING)
    return Explanation(message, span=span, suggestion=meant if is_meant and span is not None else None)


def _without_items(error: AttributeError, place: Place) -> Explanation | None:
    """Return what has `items` in place of a set of two things, or of pairs, which need none."""
    # Here, because only such mistakes need them.
    import ast  # noqa: PLC0415

    from orchestra.compat.forms_of_sets import with_colon  # noqa: PLC0415

    tree = tree_of(place.file)
    node = None if tree is None else tree.expression(place.file, place.span)
    node = node.func if isinstance(node, ast.Call) else node
    held = tree.meaning(node.value) if tree is not None and isinstance(node, ast.Attribute) else None
    if isinstance(error.obj, set) and isinstance(held, ast.Set):
        span = node_span(place.file, held)
        meant = with_colon(text_at(place.file, span))
        message = "a set has no items: a colon makes a dictionary of it"
        return Explanation(message, span=span, suggestion=None if meant is None else Rewritten(meant))
    are_pairs = isinstance(error.obj, list) and all(isinstance(item, tuple) for item in error.obj)
    if are_pairs and isinstance(node, ast.Attribute):
        source = text_at(place.file, node_span(place.file, node.value))
        return Explanation(f"pairs need no .items(): {source}", span=word_in(place.file, place.span, "items"))
    return None


def _no_name(name: str, module: ModuleType, place: Place) -> Explanation:
    module_name = module.__name__.removeprefix(f"{ROOM}.")
    elsewhere = [package for package in exporting(name) if package != module_name]
    other = word_in(place.file, place.span, module_name)
    if elsewhere and other is not None and _is_alike(module_name, elsewhere[0]):
        return Explanation(f"{module_name} has no '{name}'", span=other, suggestion=elsewhere[0])
    meant = nearest(name, _public(getattr(module, "__all__", dir(module))))
    span, told = word_in(place.file, place.span, name), f"{module_name} has no '{name}'"
    if elsewhere:
        told, meant = f"{told}: it is in {elsewhere[0]}", importing(name)
    return Explanation(told, span=span, suggestion=meant)


def _is_alike(module: str, other: str) -> bool:
    """Return whether one module is surely written for another one: `launch.substitution` for `launch.substitutions`."""
    (parent, _, last), (other_parent, _, other_last) = module.rpartition("."), other.rpartition(".")
    return parent == other_parent and (is_one_slip(last, other_last) or other_last.startswith(last))


def _no_module(name: str, place: Place) -> Explanation:
    name = name.removeprefix(f"{ROOM}.")
    parent, _, last = name.rpartition(".")
    path: Any = getattr(sys.modules.get(parent or ROOM), "__path__", ())
    meant = nearest(last, (module.name for module in iter_modules(path) if parent or module.ispkg))
    span = word_in(place.file, place.span, name)
    if not parent and _is_beside(place, last):
        return Explanation(f"there is no Python module '{name}' here", span=span, notes=(_BESIDE,))
    if not parent and (meant is None or not (is_one_slip(last, meant) or last == f"{meant}s")):
        meant = _installed(last)
    full = package_meant(name, _imported(name, place)) or (
        None if meant is None else f"{parent}.{meant}".lstrip(".")
    )
    if parent or full is not None:
        return Explanation(f"there is no Python module '{name}' here", span=span, suggestion=full)
    severity, _, _ = connection().missing_package(name)  # modules come with packages
    return Explanation(f"there is no Python module '{name}' {HERE}", span=span, severity=severity)


def _imported(module: str, place: Place) -> list[str]:
    """Return the names that the import at a place is to have from a module."""
    # Here, because only mistakes need it.
    import ast  # noqa: PLC0415

    tree = tree_of(place.file)
    for node in () if tree is None else tree.nodes:
        if isinstance(node, ast.ImportFrom) and (node.module, node.lineno) == (module, place.span.line):
            return [item.name for item in node.names]
    return []


def _installed(name: str) -> str | None:
    """Return the module of Python or of a package that one which is not there is surely a slip for.

    Other names that are alike are those of modules that come with packages: `launch_pal` is no slip for `launch_yaml`.
    """
    installed = {module.name for module in iter_modules() if not module.name.startswith("_")}
    known = installed | {module for module in sys.stdlib_module_names if not module.startswith("_")}
    return nearest(name, (module for module in known if is_one_slip(name, module)))


def _is_beside(place: Place, module: str) -> bool:
    folder = Path(place.file).parent
    return (folder / f"{module}.py").is_file() or (folder / module / "__init__.py").is_file()


def _public(names: Iterable[str]) -> list[str]:
    return [name for name in names if not name.startswith("_")]
