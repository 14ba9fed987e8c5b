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
            if not found.startswith(os.path.join(folder, name)):  # noqa: PTH118 - as above
                return name
    return None


def _is_module(folder: str, entry: str) -> bool:
    if entry.endswith(_SUFFIXES):
        return True
    return any(os.path.exists(os.path.join(folder, entry, "__init__" + suffix)) for suffix in _SUFFIXES)  # noqa: PTH110, PTH118
