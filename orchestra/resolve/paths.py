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
    return file_below(_folder(run.context.file), value, what, run)


def beside(file: str | None, written: str) -> str | None:
    """Return the absolute path of a file that a launch file names, None where there is none."""
    return _found(_folder(file), written)


def file_below(folder: Path, value: Value, what: str, run: Resolution) -> str | None:
    """Return the absolute path of a file given relative to a folder, or to the working directory."""
    found = _found(folder, value.text)
    if found is not None:
        return found
    path = folder / _expanded(value.text)
    near = _near(path)
    suggestion = str(Path(value.text).with_name(near)) if near is not None else None
    message = f"there is no {what} {displayed(str(path))}"
    run.problems.error(Code.MISSING_FILE, message, value.location, suggestion=suggestion)
    return None


def _folder(file: str | None) -> Path:
    return Path(file).parent if file else Path.cwd()


def _found(folder: Path, written: str) -> str | None:
    path = _expanded(written)
    for candidate in (folder / path, Path.cwd() / path):
        try:
            if candidate.is_file():
                return os.path.normpath(candidate)
        except ValueError:  # a text with NUL is no path
            return None
    return None


def _expanded(written: str) -> Path:
    try:
        return Path(written).expanduser()
    except RuntimeError:  # `~somebody` where there is no somebody
        return Path(written)


def _near(path: Path) -> str | None:
    """Return the name of a file in the same folder that was probably meant."""
    try:
        names = [entry.name for entry in path.parent.iterdir() if entry.is_file()]
    except (OSError, ValueError):
        return None
    return nearest(path.name, names)
