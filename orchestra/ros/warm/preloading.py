"""What nodes have in common is imported once: rclpy, the messages it uses itself, and those that the plan's nodes name.

Only interface packages, the standard library and few libraries are imported, of which it is known that importing them
does nothing but define; never code of users. What a node imports is read from its source, not found by running it.
"""

from __future__ import annotations

import ast
import os
import sys
from contextlib import suppress
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from orchestra.ros.warm.algebra import load_algebra
from orchestra.ros.warm.type_supports import load_type_supports

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

# rclpy imports the latter where it uses them first: with the first node, its parameters and its clock.
_BY_NODES = (
    *("rclpy", "rclpy.node", "rclpy.executors"),
    *("rosidl_generator_py", "rosidl_parser.parser"),
)
_MESSAGES = {
    "builtin_interfaces.msg": ("Time", "Duration"),
    "rcl_interfaces.msg": ("ParameterEvent", "Log"),
    "rcl_interfaces.srv": (
        *("DescribeParameters", "GetParameters", "GetParameterTypes", "ListParameters"),
        *("SetParameters", "SetParametersAtomically"),
    ),
    "rosgraph_msgs.msg": ("Clock",),
    "type_description_interfaces.srv": ("GetTypeDescription",),
}
_LIBRARIES = frozenset(
    {
        "ament_index_python",
        "message_filters",
        "numpy",
        "rclpy",
        "tf2_geometry_msgs",
        "tf2_py",
        "tf2_ros",
        "yaml",
    }
)
# Of the standard library: they do something when they are imported, or keep a secret of the process.
_NOT = frozenset({"antigravity", "idlelib", "multiprocessing", "readline", "this", "tkinter", "turtle"})
_INTERFACES = ("msg", "srv", "action")
_INDEX = Path("share", "ament_index", "resource_index", "rosidl_interfaces")
# Types that a service consists of.
_OF_SERVICES = ("Request", "Response", "Event")
_DEEPEST = 4  # modules of users that import each other are followed so far


def preload_common() -> None:
    """Import what every node needs. Raises `ImportError` where there is no rclpy."""
    load_algebra()
    for name in _BY_NODES:
        import_module(name)
    for module, names in _MESSAGES.items():
        with suppress(ImportError):  # not every version of rclpy needs all
            _import_interfaces(module, names)


def preload(targets: Iterable[tuple[str, str]]) -> None:
    """Import what programs (kind, and path or module) name at their tops, as far as that is known to be harmless.

    What cannot be imported is left to the node, which gets the error.
    """
    seen: set[str] = set()
    for kind, target in targets:
        folder = str(Path(target).parent) if kind == "script" else os.getcwd()  # noqa: PTH109 - a word
        path = target if kind == "script" else _source_of(target, folder)
        if path:
            _preload_for(path, folder, seen, 0)


def _preload_for(path: str, folder: str, seen: set[str], depth: int) -> None:
    if path in seen or depth > _DEEPEST:
        return
    seen.add(path)
    for module, names in _imports(path):
        top = module.partition(".")[0]
        own = _lies_in(folder, top)
        if module in sys.modules and not names and not own:
            continue
        if not own and (top in sys.stdlib_module_names or top in _LIBRARIES):
            if top not in _NOT:
                with suppress(Exception):
                    import_module(module)
        elif not own and module.endswith(_INTERFACES) and _is_interface(top):
            with suppress(Exception):
                _import_interfaces(module, names)
        else:
            for source in (
                _source_of(module, folder),
                *(_source_of(f"{module}.{name}", folder) for name in names),
            ):
                if source:
                    _preload_for(source, folder, seen, depth + 1)


def _imports(path: str) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Yield each module that a file imports when it is imported itself, with the names that are taken from it."""
    try:
        tree = ast.parse(Path(path).read_bytes())
    except (OSError, SyntaxError, ValueError):
        return
    for statement in tree.body:
        if isinstance(statement, ast.Import):
            yield from ((alias.name, ()) for alias in statement.names)
        elif isinstance(statement, ast.ImportFrom) and statement.module and not statement.level:
            yield statement.module, tuple(alias.name for alias in statement.names)


def _import_interfaces(module: str, names: Iterable[str]) -> None:
    """Import types, and what connects them with the middleware, which else is loaded where they are used first."""
    types = import_module(module)
    for name in names:
        whole = getattr(types, name, None)
        for kind in (whole, *(getattr(whole, part, None) for part in _OF_SERVICES)):
            generated: Any = type(kind)
            if getattr(generated, "_TYPE_SUPPORT", ...) is None:
                generated.__import_type_support__()
    load_type_supports(module.partition(".")[0])


def _is_interface(package: str) -> bool:
    """Tell whether a package is generated from interface definitions."""
    listed = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    return any(Path(prefix, _INDEX, package).exists() for prefix in (*filter(None, listed), sys.prefix))


def _lies_in(folder: str, module: str) -> bool:
    """Tell whether a program in a folder finds a module there."""
    beside = Path(folder, module)
    return beside.with_suffix(".py").exists() or (beside / "__init__.py").exists()


def _source_of(module: str, folder: str) -> str | None:
    """Return the file of a module, which is not imported, and neither are the packages around it."""
    top, *rest = module.split(".")
    if _lies_in(folder, top):
        place = Path(folder, top)
    else:
        spec = None
        with suppress(Exception):
            spec = find_spec(top)
        if spec is None or spec.origin is None:
            return None
        place = (
            Path(spec.origin).parent if spec.submodule_search_locations else Path(spec.origin).with_suffix("")
        )
    place = place.joinpath(*rest)
    for file in (place.with_suffix(".py"), place / "__init__.py"):
        if file.is_file():
            return str(file)
    return None
