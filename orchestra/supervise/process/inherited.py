"""What a program inherits and posix_spawn(3) cannot set: we have it ourselves for the moment of the start.

That is sound in the supervisor alone: its other thread opens files by absolute paths, and `open_files` keeps out of its
way.
"""

from __future__ import annotations

import os
import resource
from contextlib import contextmanager
from functools import cache
from typing import TYPE_CHECKING

from orchestra.supervise.keeping.kernel import LOCKS
from orchestra.supervise.process import open_files

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.supervise.process.spec import Spec


@contextmanager
def inherited(spec: Spec) -> Iterator[None]:
    """Have the number of a program, the limits of open files that it is to have, and its working directory.

    Raises `OSError` where one of them is not to be had.
    """
    with _numbered(spec.mark), open_files.as_given(), _working(spec.cwd):
        yield


@contextmanager
def _working(folder: str | None) -> Iterator[None]:
    if folder is None:
        yield
        return
    before = os.open(".", os.O_PATH | os.O_DIRECTORY | os.O_CLOEXEC)
    try:
        os.chdir(folder)
        yield
    finally:
        os.fchdir(before)
        os.close(before)


@contextmanager
def _numbered(mark: int | None) -> Iterator[None]:
    if mark is None:
        yield
        return
    soft, hard = _own()
    resource.setrlimit(LOCKS, (mark if hard == resource.RLIM_INFINITY else min(mark, hard), hard))
    try:
        yield
    finally:
        resource.setrlimit(LOCKS, (soft, hard))


@cache
def _own() -> tuple[int, int]:
    """Return the number that all of a run's own processes have, and how high one may be."""
    return resource.getrlimit(LOCKS)
