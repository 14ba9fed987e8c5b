"""What `ros_wheels_bootstrapper` 0.1, which comes with ROS as Python packages, does to an interpreter that starts.

It starts the interpreter a second time, with the folders of the wheels' shared libraries on LD_LIBRARY_PATH, in an
order that differs from start to start, and with a variable that tells that this is done.
"""

from __future__ import annotations

import os
import sys

TYPE_CHECKING = False  # `typing` costs more than this module, which every start imports
if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

DONE = "_ROS_WHEELS_BOOTSTRAP_COMPLETE"
LIBRARY_PATH = "LD_LIBRARY_PATH"
# A file of this name is in a folder that stands for those of the wheels (`supervise.libraries`).
STAMP = ".wheels"


_KNOWN: dict[str, tuple[str, ...]] = {}  # nobody installs wheels for a process that runs


def library_folders(prefix: Path) -> tuple[str, ...]:
    """Return the folders that it puts on LD_LIBRARY_PATH, in an order that stays; none where it is not installed."""
    where = str(prefix)
    if where not in _KNOWN:
        _KNOWN[where] = _library_folders(where)
    return _KNOWN[where]


def _library_folders(prefix: str) -> tuple[str, ...]:
    """Look for them; without pathlib, which takes several times as long for some fifty folders."""
    packages = f"{prefix}/lib/python{sys.version_info.major}.{sys.version_info.minor}/site-packages"
    if not os.path.isdir(f"{packages}/ros_wheels_bootstrapper"):  # noqa: PTH112
        return ()
    real = os.path.realpath(packages)
    with os.scandir(packages) as entries:
        found = [entry for entry in entries if entry.name.startswith("ros_") and entry.name.endswith(".libs")]
        folders = [
            os.path.realpath(entry.path) if entry.is_symlink() else f"{real}/{entry.name}"
            for entry in found
            if entry.is_dir()
        ]
    return (f"{prefix}/lib", *sorted(folders))


def as_called(environment: Mapping[str, str]) -> Mapping[str, str]:
    """Return the environment in which this interpreter was called, given the one that it has."""
    if DONE not in environment:
        return environment
    from pathlib import Path  # noqa: PLC0415 - the wheels have imported it

    called = {name: value for name, value in environment.items() if name not in {DONE, LIBRARY_PATH}}
    added = frozenset(library_folders(Path(sys.prefix)))
    entries = filter(None, environment.get(LIBRARY_PATH, "").split(":"))
    before = [entry for entry in entries if entry not in added and not os.path.exists(f"{entry}/{STAMP}")]  # noqa: PTH110
    return {**called, LIBRARY_PATH: ":".join(before)} if before else called
