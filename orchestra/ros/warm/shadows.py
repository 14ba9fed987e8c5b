"""Modules that a program would have found in its own folder, and that the server has imported from elsewhere."""

from __future__ import annotations

import os
import sys
from importlib.machinery import all_suffixes
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Collection

_SUFFIXES = tuple(all_suffixes())


def loaded_since(modules: Collection[str]) -> frozenset[str]:
    """Return the top-level modules of sys.modules that an interpreter without a program (`modules`) does not have."""
    return frozenset({name.partition(".")[0] for name in sys.modules} - set(modules))


def shadowed(folder: str, loaded: Collection[str]) -> str | None:
    """Return the name of a module in a folder that is loaded from elsewhere, None where there is none."""
    try:
        entries = os.listdir(folder)  # noqa: PTH208 - this is on the way of each node
    except OSError:
        return None
    for entry in entries:
        name = entry.partition(".")[0]
        if name in loaded and not name.startswith("_") and _is_module(folder, entry):
            found = getattr(sys.modules.get(name), "__file__", None) or ""
            place = os.path.join(folder, name)  # noqa: PTH118 - as above
            if not found.startswith(place) and not _is_copy(place + ".py", found):
                return name
    return None


def _is_copy(path: str, loaded: str) -> bool:
    """Tell whether a file is the module that is loaded, but for the first line that an installer gives to scripts.

    empy, which every rclpy needs, installs its module as a script too, beside the console scripts of nodes.
    """
    try:
        return _below_the_first_line(path) == _below_the_first_line(loaded)
    except OSError:
        return False


def _below_the_first_line(path: str) -> bytes:
    with open(path, "rb") as file:  # noqa: PTH123 - as above
        first = file.readline()
        return file.read() if first.startswith(b"#!") else first + file.read()


def _is_module(folder: str, entry: str) -> bool:
    if entry.endswith(_SUFFIXES):
        return True
    return any(os.path.exists(os.path.join(folder, entry, "__init__" + suffix)) for suffix in _SUFFIXES)  # noqa: PTH110, PTH118
