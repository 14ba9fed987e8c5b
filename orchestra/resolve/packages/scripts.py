"""Console scripts of the installed distributions, by the package that they start something in or are shipped with.

Read from `entry_points.txt` and `RECORD` (packaging.python.org, "Entry points specification" and "Recording
installed projects") without `importlib.metadata`, which costs more to import than all of this. Where a script lies is
found out for those that somebody asks for: records are long.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator

_KINDS: Final = (".dist-info", ".egg-info")


class Script(NamedTuple):
    """A script as a distribution declares it; `owners` are the packages by which it is called."""

    name: str
    owners: tuple[str, str]
    metadata: str


def declared_scripts() -> tuple[Script, ...]:
    """Return all scripts that are declared, in the order of the import path."""
    return tuple(script for place in dict.fromkeys(sys.path) for script in _declared_in(place or "."))


def script_file(package: str, name: str, declared: tuple[Script, ...]) -> Path | None:
    """Return the file of a script that can be executed: the first by that name of a package."""
    for script in declared:
        if script.name == name and package in script.owners:
            path = _script_path(Path(script.metadata), name)
            if os.access(path, os.X_OK):
                return path
    return None


def _declared_in(place: str) -> Iterator[Script]:
    try:
        names = sorted(os.listdir(place))  # noqa: PTH208 - pathlib is slow
    except OSError:
        return
    for kind in _KINDS:
        for name in names:
            if name.endswith(kind):
                shipped_with = name.partition("-")[0].removesuffix(".egg").replace(".", "_")
                metadata = os.path.join(place, name)  # noqa: PTH118 - as above
                for package, script in _listed(os.path.join(metadata, "entry_points.txt")):  # noqa: PTH118 - as above
                    yield Script(script, (package, shipped_with), metadata)


def _listed(entry_points: str) -> Iterator[tuple[str, str]]:
    """Yield the pairs of top-level package and script name of one distribution."""
    try:
        with open(entry_points, encoding="utf-8") as file:  # noqa: PTH123 - as above
            lines = file.read().splitlines()
    except OSError:
        return
    section = ""
    for line in lines:
        text = line.strip()
        if text.startswith("["):
            section = text
        elif section == "[console_scripts]" and "=" in text and not text.startswith(("#", ";")):
            script, _, target = text.partition("=")
            yield target.partition(":")[0].strip().partition(".")[0], script.strip()


def _script_path(metadata: Path, script: str) -> Path:
    """Return where a distribution's script lies: where its record says, else in the interpreter's folder."""
    # Both are slow, and few launch files name a Python package.
    import csv  # noqa: PLC0415
    import sysconfig  # noqa: PLC0415

    record = metadata / "RECORD"
    if record.is_file():
        with record.open(encoding="utf-8", newline="") as file:
            for row in csv.reader(file):
                if row and Path(row[0]).name == script and row[0].startswith(("..", "/")):
                    return Path(os.path.normpath(metadata.parent / row[0]))
    return Path(sysconfig.get_path("scripts"), script)
