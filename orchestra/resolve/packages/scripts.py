"""Console scripts of the installed distributions, by the package that they start something in or are shipped with.

Read from `entry_points.txt` and `RECORD` (packaging.python.org, "Entry points specification" and "Recording
installed projects") without `importlib.metadata`, which costs more to import than all of this.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

_METADATA = ("*.dist-info/entry_points.txt", "*.egg-info/entry_points.txt")


def console_scripts() -> dict[tuple[str, str], Path]:
    """Return the script files that can be executed, by the pair of package and script name."""
    found: dict[tuple[str, str], Path] = {}
    for place in map(Path, dict.fromkeys(sys.path)):
        for pattern in _METADATA:
            for entry_points in sorted(place.glob(pattern)):
                metadata = entry_points.parent
                shipped_with = metadata.name.partition("-")[0].removesuffix(".egg").replace(".", "_")
                for package, script in _listed(entry_points):
                    path = _script_path(metadata, script)
                    if os.access(path, os.X_OK):
                        found.setdefault((package, script), path)
                        found.setdefault((shipped_with, script), path)
    return found


def _listed(entry_points: Path) -> Iterator[tuple[str, str]]:
    """Yield the pairs of top-level package and script name of one distribution."""
    section = ""
    for line in entry_points.read_text("utf-8").splitlines():
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
