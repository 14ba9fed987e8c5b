"""Python packages as places for launch files and nodes, found without importing them."""

from __future__ import annotations

import os
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.location import is_file
from orchestra.witness.searching import searched

if TYPE_CHECKING:
    from collections.abc import Mapping

# Where prefixes keep the Python packages that come with launch files.
_LIBRARIES = ("lib/python3*/site-packages", "local/lib/python3*/dist-packages", "lib/python3*/dist-packages")
_NOT_NODES = frozenset({"__init__", "__main__"})


def libraries(environment: Mapping[str, str]) -> list[str]:
    """Return the folders with Python packages in the ament prefixes, for those that are not on the path already."""
    prefixes = [
        Path(prefix) for prefix in environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if prefix
    ]
    found = [
        str(path) for prefix in prefixes for pattern in _LIBRARIES for path in sorted(prefix.glob(pattern))
    ]
    return [path for path in found if path not in sys.path]


def folder(package: str) -> Path | None:
    """Return the folder of an importable package, None for anything else.

    Left out: the standard library, and folders without `__init__.py`, because every folder on the path is one.
    """
    if not package.isidentifier() or package in sys.stdlib_module_names or package == "__main__":
        return None
    spec = find_spec(package)
    searched(sys.path, None if spec is None else spec.submodule_search_locations)
    if spec is None or spec.origin is None or not spec.submodule_search_locations:
        return None
    return Path(spec.submodule_search_locations[0]).absolute()


def source(package_folder: Path) -> Path | None:
    """Return the folder of the source package of ament_python around a Python package, None where there is none.

    It holds what colcon and `pip install` copy into the share folder (manifest, launch files, configurations), and is
    known by the marker that they copy into the index, `resource/PKG`. An editable installation copies nothing.
    """
    around = package_folder.parent
    files = (around / "package.xml", around / "resource" / package_folder.name)
    return around if all(map(is_file, files)) else None


def nodes(package_folder: Path) -> tuple[str, ...]:
    """Return the names of the modules of `PKG.nodes` that can be run with `python -m`."""
    container = package_folder / "nodes"
    if not container.is_dir():
        return ()
    return tuple(
        sorted(
            path.stem
            for path in container.iterdir()
            if path.stem.isidentifier() and path.stem not in _NOT_NODES and _is_runnable(path)
        )
    )


def packages_with_nodes() -> tuple[str, ...]:
    """Return the names of the packages on the import path that have a folder `nodes` beside `__init__.py`."""
    return tuple(
        sorted(
            {
                entry.parent.name
                for place in map(Path, dict.fromkeys(sys.path))
                if place.is_dir()
                for entry in place.glob("*/nodes")
                if entry.is_dir() and (entry.parent / "__init__.py").is_file() and folder(entry.parent.name)
            }
        )
    )


def _is_runnable(path: Path) -> bool:
    return path.suffix == ".py" or (path / "__main__.py").is_file()
