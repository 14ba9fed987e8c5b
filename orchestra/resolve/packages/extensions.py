"""Whether an installed distribution extends something, told by its `entry_points.txt`.

That nearly none does is known without `importlib.metadata`, which costs more to import than all of this.
"""

from __future__ import annotations

import os
import sys
from functools import lru_cache

from orchestra.resolve.packages.entry_points import text_in
from orchestra.witness.observing import observer
from orchestra.witness.once import once

_METADATA = (".dist-info", ".egg-info")


def extends(group: str) -> bool:
    """Return whether a distribution on the path has an entry point in a group."""
    question = ("extends", group)
    return once((*question, *sys.path), lambda: observer().answered(question, lambda: _is_extended(group)))


def _is_extended(group: str) -> bool:
    return any(group in _groups(folder, _changed(folder)) for folder in dict.fromkeys(sys.path))


def _changed(folder: str) -> int:
    try:
        return os.stat(folder or ".").st_mtime_ns  # noqa: PTH116 - no path is wanted
    except OSError:
        return 0


@lru_cache(maxsize=256)
def _groups(folder: str, _changed: int) -> frozenset[str]:
    """Return the groups in which the distributions in a folder have entry points."""
    try:
        names = [name for name in os.listdir(folder or ".") if name.endswith(_METADATA)]  # noqa: PTH208 - no path is wanted
    except OSError:
        return frozenset()
    found: set[str] = set()
    for name in names:
        lines = (line.strip() for line in text_in(f"{folder or '.'}/{name}").splitlines())
        found.update(line[1:-1].strip() for line in lines if line.startswith("[") and line.endswith("]"))
    return frozenset(found)
