"""Paths in descriptions: relative to the launch file first, then to the working directory."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.location import displayed
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from orchestra.resolve.context import Value
    from orchestra.resolve.resolution import Resolution


def existing_file(value: Value, what: str, run: Resolution) -> str | None:
    """Return the absolute path of a file, None where there is none (which has been reported)."""
    folder = Path(run.context.file).parent if run.context.file else Path.cwd()
    return file_below(folder, value, what, run)


def file_below(folder: Path, value: Value, what: str, run: Resolution) -> str | None:
    """Return the absolute path of a file given relative to a folder, or to the working directory."""
    written = Path(value.text).expanduser()
    for candidate in (folder / written, Path.cwd() / written):
        if candidate.is_file():
            return os.path.normpath(candidate)
    near = _near(folder / written)
    suggestion = str(Path(value.text).with_name(near)) if near is not None else None
    message = f"there is no {what} {displayed(str(folder / written))}"
    run.problems.error(Code.MISSING_FILE, message, value.location, suggestion=suggestion)
    return None


def _near(path: Path) -> str | None:
    """Return the name of a file in the same folder that was probably meant."""
    try:
        names = [entry.name for entry in path.parent.iterdir() if entry.is_file()]
    except OSError:
        return None
    return nearest(path.name, names)
