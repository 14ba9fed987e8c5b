"""The ament resource index: a marker file per package in `PREFIX/share/ament_index/resource_index/packages`."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.location import is_file

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

_RESOURCES = Path("share", "ament_index", "resource_index")
_INDEX = _RESOURCES / "packages"


def prefixes(environment: Mapping[str, str]) -> tuple[Path, ...]:
    """Return the prefixes that have an index: those of `AMENT_PREFIX_PATH`, then the interpreter's own.

    The ROS wheels put their index below the interpreter's prefix and do not set the variable.
    """
    listed = (folder for folder in environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if folder)
    return tuple(dict.fromkeys(path for path in map(Path, (*listed, sys.prefix)) if (path / _INDEX).is_dir()))


def packages(prefix: Path) -> tuple[str, ...]:
    """Return the names of the packages in a prefix."""
    return tuple(sorted(marker.name for marker in (prefix / _INDEX).iterdir() if _is_marker(marker)))


def has(prefix: Path, package: str) -> bool:
    """Return whether the index of a prefix lists the package."""
    return bool(package) and "/" not in package and _is_marker(prefix / _INDEX / package)


def resources(prefix: Path, kind: str) -> Iterator[tuple[str, str]]:
    """Yield the packages of a prefix that have a resource of a kind, and its text."""
    folder = prefix / _RESOURCES / kind
    for path in sorted(folder.iterdir()) if folder.is_dir() else ():
        if _is_marker(path):
            yield path.name, path.read_text("utf-8", "replace")


def resource(prefix: Path, kind: str, package: str) -> str | None:
    """Return the text of the resource of a kind that a package has in a prefix, None where it has none."""
    path = prefix / _RESOURCES / kind / package
    return path.read_text("utf-8", "replace") if is_file(path) else None


def executables(prefix: Path, package: str) -> dict[str, Path]:
    """Return the executables of a package by name: the executable files in `PREFIX/lib/PKG`."""
    folder = prefix / "lib" / package
    if not folder.is_dir():
        return {}
    return {
        path.name: path for path in sorted(folder.iterdir()) if path.is_file() and os.access(path, os.X_OK)
    }


def _is_marker(path: Path) -> bool:
    return not path.name.startswith(".") and is_file(path)
