"""Temporary files of user code: all in one folder, with names that are the same each time."""

from __future__ import annotations

import os
import shutil
import stat
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
    folder = _left_empty(watching.scratch) or tempfile.mkdtemp(prefix=files.prefix, dir=files.above)
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
                # For the next file: whoever has made what is around it removes that.
                if watching.installed and _is_below(watching.scratch, folder) and _is_as_made(folder):
                    _unused.append(folder)
                else:
                    _remove(folder)


_unused: list[str] = []


def _left_empty(scratch: str | None) -> str | None:
    """Return a folder that an earlier file has left empty, below the folder for all of them."""
    with observer().aside():
        while _unused:
            folder = _unused.pop()
            if _is_below(scratch, folder) and _is_as_made(folder):
                return folder
    return None


def _is_below(scratch: str | None, folder: str) -> bool:
    return scratch is not None and folder.startswith(f"{scratch}/")


def _is_as_made(folder: str) -> bool:
    """Tell whether a folder is empty, and its own user's alone."""
    try:
        found = os.stat(folder)  # noqa: PTH116 - pathlib is slow
        return found.st_mode == stat.S_IFDIR | stat.S_IRWXU and not os.listdir(folder)  # noqa: PTH208 - as above
    except OSError:
        return False


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
