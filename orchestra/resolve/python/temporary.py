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
    folder = tempfile.mkdtemp(prefix="orchestra-")
    before = tempfile.tempdir, tempfile._name_sequence  # type: ignore[attr-defined] # there is no public way
    tempfile.tempdir, tempfile._name_sequence = folder, _Names()  # type: ignore[attr-defined]
    files.folder = folder
    watching = observer()
    watching.scratch = watching.scratch or folder  # what it is called tells nothing
    try:
        yield
    finally:
        tempfile.tempdir, tempfile._name_sequence = before  # type: ignore[attr-defined]
        if not files.kept:
            with observer().aside():
                _remove(folder)


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
