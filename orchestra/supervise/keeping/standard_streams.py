"""What keeper, supervisor and resolver write themselves, to streams that may be closed, blocked or nobody's."""

from __future__ import annotations

import contextlib
import os
import select
import stat
import sys

# A pipe that poll(2) calls writable takes this much without blocking (PIPE_BUF, pipe(7)).
_CAREFUL_PIECE = 512


def fill_standard_descriptors() -> None:
    """Open what is closed of 0, 1 and 2 on /dev/null, so that no pipe or file of ours gets such a number."""
    while True:
        descriptor = os.open(os.devnull, os.O_RDWR)
        if descriptor > 2:  # noqa: PLR2004 - standard error
            os.close(descriptor)
            return
        os.set_inheritable(descriptor, True)


def flush() -> None:
    """Write out what Python still holds; either stream may be closed, or nobody may read it."""
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError, ValueError, AttributeError):
            stream.flush()


def say(text: str) -> None:
    """Tell the user something, as far as that is possible at once: a stuck terminal must not keep anything alive."""
    with contextlib.suppress(OSError):
        _write(f"[orchestra] {text}\n".encode())


def _write(data: bytes) -> None:
    """Write to standard error what it takes now.

    O_NONBLOCK must not be set on it, for it is shared with the shell; opened anew it is our own. A regular file never
    blocks for long, and opened anew would be written from its begin.
    """
    if stat.S_ISREG(os.fstat(2).st_mode):
        os.write(2, data)
        return
    try:
        own = os.open("/proc/self/fd/2", os.O_WRONLY | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC)
    except OSError:  # a socket, or a terminal of another user
        _write_carefully(data)
        return
    try:
        os.write(own, data)
    finally:
        os.close(own)


def _write_carefully(data: bytes) -> None:
    poll = select.poll()
    poll.register(2, select.POLLOUT)
    while data and poll.poll(0):
        data = data[os.write(2, data[:_CAREFUL_PIECE]) :]
