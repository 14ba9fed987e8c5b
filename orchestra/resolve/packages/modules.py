"""Modules that can be run with `python -m`, found without importing anything.

A finder may know more than folders show (zip files, finders of others): of what is found there nothing is told.
"""

from __future__ import annotations

import os
import sys
from importlib.machinery import all_suffixes
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

from orchestra.location import is_file
from orchestra.nearest import nearest
from orchestra.witness.searching import searched

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

_SUFFIXES: Final = tuple(all_suffixes())


class Unrunnable(NamedTuple):
    """Why a module cannot be run, and the whole name of the one that was meant.

    `certain` is false where another environment may have it: where not even its first part is here.
    """

    told: str
    meant: str | None = None
    certain: bool = True


def unrunnable(module: str, cwd: str) -> Unrunnable | None:
    """Return why a module cannot be run in a folder, None where nothing speaks against it.

    `cwd` is the working directory, in which `python -m` looks first.
    """
    places = _places(module, cwd)
    if isinstance(places, Unrunnable):
        return places
    if places and all(map(os.path.isdir, places)) and _look(places, "__main__") is None:
        return Unrunnable(f"{module!r} is a package without `__main__`: it cannot be run")
    return None


def unimportable(module: str, cwd: str) -> Unrunnable | None:
    """Return why a module cannot be imported in a folder, None where nothing speaks against it."""
    places = _places(module, cwd)
    return places if isinstance(places, Unrunnable) else None


def source_of(module: str, cwd: str) -> Path | None:
    """Return the source of a module that can be imported, None where nobody can tell."""
    above, _, name = module.rpartition(".")
    folders = _places(above, cwd) if above else [cwd, *sys.path]
    if isinstance(folders, Unrunnable):
        return None
    found = (Path(folder, name) for folder in folders)
    paths = (path for stem in found for path in (stem / "__init__.py", stem.with_name(f"{name}.py")))
    return next((path for path in paths if is_file(path)), None)


def _places(module: str, cwd: str) -> list[str] | Unrunnable:
    """Return the folders of a package, none for a module or where nobody can tell, or why it cannot be found."""
    parts = module.split(".")
    if not all(part.isidentifier() for part in parts):
        return Unrunnable(f"{module!r} is no name of a module")
    places = _top(parts[0], cwd)
    if places is None:
        folders = [cwd, *sys.path]
        return _missing(parts, 0, folders, certain=False)
    for index, part in enumerate(parts[1:], 1):
        if not all(map(os.path.isdir, places)):
            return []
        if not places:
            return Unrunnable(f"module {'.'.join(parts[:index])!r} is no package: it has no {part!r}")
        inner = _look(places, part)
        if inner is None:
            return _missing(parts, index, places)
        places = inner
    return places


def _missing(parts: Sequence[str], index: int, folders: Iterable[str], *, certain: bool = True) -> Unrunnable:
    meant = nearest(parts[index], _names(folders))
    whole = None if meant is None else ".".join((*parts[:index], meant, *parts[index + 1 :]))
    return Unrunnable(f"there is no module {'.'.join(parts[: index + 1])!r}", whole, certain)


def _top(name: str, cwd: str) -> list[str] | None:
    """Return the folders of a top-level package, none for a module, None where there is no such."""
    own = _look([cwd], name)
    if own == []:
        return own
    try:
        spec = find_spec(name)
    except (ImportError, ValueError):  # a module that has none, `__main__`
        spec = None
    inside = None if spec is None else spec.submodule_search_locations
    searched(sys.path, inside)
    if own is None and spec is None:
        return None
    return [*(own or ()), *(inside or ())]


def _look(folders: Iterable[str], name: str) -> list[str] | None:
    """Return the folders of a package in others, none for a module, None where there is no such."""
    found = list[str]()
    searched(folders, None)
    for folder in folders:
        path = str(Path(folder, name))
        if _is_package(path):
            return [path]
        if any(is_file(path + suffix) for suffix in _SUFFIXES):
            return []
        if Path(path).is_dir():
            found.append(path)
    return found or None


def _is_package(path: str) -> bool:
    return any(is_file(f"{path}/__init__{suffix}") for suffix in _SUFFIXES)


def _names(folders: Iterable[str]) -> set[str]:
    """Return the names of the modules and packages in folders."""
    entries = (path for folder in map(Path, folders) if folder.is_dir() for path in folder.iterdir())
    return {
        path.name.partition(".")[0]
        for path in entries
        if path.name.endswith(_SUFFIXES) or ("." not in path.name and _is_package(str(path)))
    } - {"__init__"}
