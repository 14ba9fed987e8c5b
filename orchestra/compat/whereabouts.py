"""Where the names of the launch language are to be had, and those of Python that launch files use."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.borrowed import PACKAGES, ROOM
from orchestra.compat.rewritten import Rewritten
from orchestra.nearest import is_slip, nearest

if TYPE_CHECKING:
    from collections.abc import Iterable

_ALL: Final = (
    *PACKAGES,
    "launch.events.process",
    "launch_ros.event_handlers",
    "launch_ros.events",
    "launch_ros.events.lifecycle",
    "launch_xml.launch_description_sources",
    "launch_yaml.launch_description_sources",
    "ament_index_python.packages",
    "launch.descriptions",
    "launch_testing.actions",
)
_MODULES: Final = frozenset(
    {"glob", "json", "launch", "launch_ros", "math", "os", "pathlib", "random", "re", "shutil", "socket"}
    | {"subprocess", "sys", "tempfile", "time", "xacro", "yaml"}
)
_OF_PYTHON: Final = {"Path": "pathlib", "deepcopy": "copy"}
_LONG: Final = 4  # letters of a name that is likely to be one of the launch language


def exporting(name: str) -> list[str]:
    """Return the packages of the launch language that export a name, the likeliest first."""
    return [package for package in _ALL if name in _names(package)]


def importing(name: str) -> Rewritten | None:
    """Return the line that imports a name, None where it is neither one of the launch language nor of Python's."""
    if name in _OF_PYTHON:
        return Rewritten(f"from {_OF_PYTHON[name]} import {name}")
    packages = exporting(name)
    if packages:
        return Rewritten(f"from {packages[0]} import {name}")
    return Rewritten(f"import {name}") if name in _MODULES else None


def class_meant(name: str) -> str | None:
    """Return the class of the launch language that a name is a slip for."""
    known = (item for package in _ALL for item in _names(package) if item[:1].isupper())
    meant = nearest(name, known) if len(name) >= _LONG and name[:1].isupper() else None
    return meant if meant is not None and is_slip(name, meant) else None


def package_meant(module: str, names: Iterable[str]) -> str | None:
    """Return the package that exports all the names which are imported from a module that is not there.

    It is one that is called alike, or in part.
    """
    wanted = set(names)
    holding = [package for package in _ALL if wanted and wanted <= _names(package)]
    root, *inner = module.split(".")
    for package in holding:
        parts = package.split(".")
        if (
            package.endswith(f".{module}")
            or root == parts[0]
            or set(inner) & set(parts[1:])
            or is_slip(root, parts[0])
        ):
            return package
    return next((package for package in holding if package.startswith(f"{module}_")), None)


@cache
def _names(package: str) -> frozenset[str]:
    module = import_module(f"{ROOM}.{package}")
    exported: Any = getattr(module, "__all__", None)
    if exported is not None:
        return frozenset(exported)
    own = (
        name for name, item in vars(module).items() if getattr(item, "__module__", None) == module.__name__
    )
    return frozenset(name for name in own if not name.startswith("_"))
