"""Temporary files of user code: all in one folder, with names that are the same each time."""

from __future__ import annotations

import os
import shutil
import tempfile
from contextlib import contextmanager
from itertools import count
from typing import TYPE_CHECKING

from orchestra.witness.observing import observer

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.resolve.python.files import Files


@contextmanager
def temporary_files(files: Files) -> Iterator[None]:
    """Let `tempfile` use a folder of its own, which goes away afterwards unless the files are to be kept.

    The names count up instead of being drawn by lot: two plans of one description name the same files.
    """
    watching = observer()
    folder = _unused.pop() if _unused else tempfile.mkdtemp(prefix="orchestra-")
    new = _state(folder)
    before = tempfile.tempdir, tempfile._name_sequence  # type: ignore[attr-defined] # there is no public way
    tempfile.tempdir, tempfile._name_sequence = folder, _Names()  # type: ignore[attr-defined]
    files.folder = folder
    watching.scratch = watching.scratch or folder  # what it is called tells nothing
    try:
        yield
    finally:
        tempfile.tempdir, tempfile._name_sequence = before  # type: ignore[attr-defined]
        if not files.kept:
            with watching.aside():
                if watching.installed and new is not None and _state(folder) == new:
                    _unused.append(
                        folder
                    )  # such a process reads many files, and what is around the folder goes away
                else:
                    _remove(folder)


_unused: list[str] = []


def _state(folder: str) -> tuple[int, int] | None:
    """Return what changes with whatever is done to a folder, or in it; None where it is gone."""
    try:
        found = os.stat(folder)  # noqa: PTH116 - pathlib is slow
    except OSError:
        return None
    return found.st_mode, found.st_mtime_ns


def _remove(folder: str) -> None:
    try:
        os.rmdir(folder)  # noqa: PTH106 - pathlib is slow; most often nothing is in it
    except OSError:
        shutil.rmtree(folder, ignore_errors=True)


class _Names:
    """Names of temporary files in order."""

    def __init__(self) -> None:
        self._numbers = count(1)

    def __iter__(self) -> _Names:
        return self

    def __next__(self) -> str:
        return f"{next(self._numbers):04}"
