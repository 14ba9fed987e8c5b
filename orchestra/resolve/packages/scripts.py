"""Console scripts of the installed distributions, by the package that they start something in or are shipped with.

Where a script lies is read from `RECORD` (packaging.python.org, "Recording installed projects"), and only for those
that somebody asks for: records are long.
"""

from __future__ import annotations

import os
from pathlib import Path

from orchestra.resolve.packages.entry_points import EntryPoint, declared

Script = EntryPoint


def declared_scripts() -> tuple[Script, ...]:
    """Return all scripts that are declared, in the order of the import path."""
    return declared("console_scripts")


def script_file(package: str, name: str, scripts: tuple[Script, ...]) -> Path | None:
    """Return the file of a script that can be executed: the first by that name of a package."""
    for script in scripts:
        if script.name == name and package in script.owners:
            path = _script_path(Path(script.metadata), name)
            if os.access(path, os.X_OK):
                return path
    return None


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
