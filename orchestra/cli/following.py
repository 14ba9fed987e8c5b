"""Waits until something is written in a folder, or the run that writes there is over, without looking in vain."""

from __future__ import annotations

import ctypes
import os
import select
from contextlib import ExitStack
from typing import TYPE_CHECKING

from orchestra.supervise.runs import identity
from orchestra.supervise.runs.running import LOCK, is_locked

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

# inotify(7): what is written to files of the folder, and files that are new in it or get another name.
_MODIFIED, _MOVED_TO, _CREATED = 0x2, 0x80, 0x100
_READ_SIZE = 65536


def looks(directory: Path, folder: Path, *, follow: bool) -> Iterator[None]:
    """Yield whenever there may be something new in a folder of a run's directory: at once, then while the run lives.

    The last time is after the end of the run; without `follow` the first is the last. Raises `OSError` where nothing
    can be watched.
    """
    yield
    if not follow:
        return
    with ExitStack() as opened:
        written = _watch(folder)
        opened.callback(os.close, written)
        yield  # what came before the watch
        writer = _writer(directory)
        if writer is None:
            yield
            return
        poll = select.poll()
        poll.register(written, select.POLLIN)
        opened.callback(os.close, writer)
        poll.register(writer, select.POLLIN)
        while True:
            ready = dict(poll.poll())
            if written in ready:
                os.read(written, _READ_SIZE)
            yield
            if writer in ready:
                return


def _writer(directory: Path) -> int | None:
    """Return a pidfd of the supervisor, None where there is none. Its lock is held: the pid is still its own."""
    known = identity.read(directory)
    if known is None:
        return None
    try:
        process = os.pidfd_open(known.supervisor)
    except ProcessLookupError:
        return None
    if is_locked(directory / LOCK):
        return process
    os.close(process)
    return None


def _watch(folder: Path) -> int:
    libc = ctypes.CDLL(None, use_errno=True)
    descriptor: int = libc.inotify_init1(os.O_CLOEXEC)
    if descriptor < 0:
        raise OSError(ctypes.get_errno(), "inotify_init1")
    if libc.inotify_add_watch(descriptor, os.fsencode(folder), _MODIFIED | _MOVED_TO | _CREATED) < 0:
        number = ctypes.get_errno()
        os.close(descriptor)
        raise OSError(number, os.strerror(number), str(folder))
    return descriptor
