"""The prefixes that are searched: those of `AMENT_PREFIX_PATH`."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from orchestra.compat.ament_index_python.constants import RESOURCE_INDEX_SUBFOLDER

_VARIABLE = "AMENT_PREFIX_PATH"


def get_search_paths() -> list[str]:
    """Return the entries of the variable that exist; where it is not set, the interpreter's prefix if it has an index.

    The ROS wheels put their index below the interpreter's prefix and do not set the variable. Raises
    `EnvironmentError` where there is nothing to search.
    """
    written = os.environ.get(_VARIABLE, "")
    if not written and not _interpreter():
        raise OSError(f"{_VARIABLE} is not set: there is nowhere to search for packages")
    if not written:
        return _interpreter()
    return [entry for entry in written.split(os.pathsep) if entry and Path(entry).exists()]


def searched() -> list[str]:
    """Return all that is searched for resources: the interpreter's prefix comes last, as it does for packages."""
    found = get_search_paths()
    return found + [prefix for prefix in _interpreter() if prefix not in found]


def _interpreter() -> list[str]:
    return [sys.prefix] if Path(sys.prefix, RESOURCE_INDEX_SUBFOLDER).is_dir() else []
