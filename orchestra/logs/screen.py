"""The user's terminal, or whatever stands in its place: it may be slow, blocked or closed, and never holds us up.

Descriptors 1 and 2 are shared with the shell and others, so O_NONBLOCK must not be set on them: it would be set for
all. They are opened anew through /proc/self/fd, which gives a file description of our own. Where that is not possible
(a socket, a terminal of another user) they are written to in small pieces when poll(2) says that it will not block. A
regular file is used as it is: it cannot block for long, and opened anew would be written from its begin.
"""

from __future__ import annotations

import os
import select
import stat
from collections import deque
from itertools import islice
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

# What is kept for a screen that does not take it; beyond that, text is dropped and counted.
BACKLOG = 4 * 1024 * 1024
# A pipe that poll(2) calls writable takes this much without blocking (PIPE_BUF).
_CAREFUL_PIECE = 512
# So many pieces are written with one call; the kernel takes no more than 1024 (writev(2)).
_AT_ONCE = 256


class Screen:
    """Writes text without ever blocking. `watch` is called with True when it wants to be told that it can go on."""

    def __init__(self, descriptor: int, watch: Callable[[bool], None]) -> None:
        self._watch = watch
        self._waiting: deque[bytes | memoryview] = deque()
        self._size = 0
        # None while nothing is missing; else how many lines have begun in what was dropped.
        self._dropped: int | None = None
        # Whether what was to be written ends within a line, whether the screen does, and whether that is another line.
        self._open = self._cut = self._lost = False
        self.closed = False
        self.descriptor, self._careful = _open_anew(descriptor)
        self._own = self.descriptor != descriptor

    @property
    def pending(self) -> int:
        """The number of bytes that the screen has not taken yet."""
        return self._size

    def write(self, data: bytes) -> None:
        """Write now what the screen takes, and keep the rest. It should consist of whole lines where it can."""
        if self.closed or not data:
            return
        continued, self._open = self._open, not data.endswith(b"\n")
        if self._size + len(data) > BACKLOG:
            self._drop(data, continued=continued)
            return
        if self._lost:
            data = self._begun(data)
        if self._dropped is not None:
            data = self._confession() + data
        if not data:
            return
        self._cut = not data.endswith(b"\n")
        self._keep(data)
        if len(self._waiting) == 1:
            self._push()
            if self._waiting:
                self._watch(True)

    def writable(self) -> None:
        """Go on writing: the screen takes more."""
        self._push()
        if not self._waiting:
            if self._dropped is not None and not self.closed:
                self._keep(self._confession())
                self._cut = False
                self._push()
            if not self._waiting:
                self._watch(False)

    def finish(self, patience: float) -> None:
        """Write what is left, as long as the screen takes some of it within `patience` seconds."""
        poll = select.poll()
        poll.register(self.descriptor, select.POLLOUT)
        while self._waiting:
            before = self._size
            if not poll.poll(patience * 1000):
                break
            self.writable()
            if self._size == before:
                break

    def close(self) -> None:
        """Give the descriptor back."""
        if self._waiting:
            self._waiting.clear()
            self._watch(False)
        if self._own:
            os.close(self.descriptor)
        self.closed = True

    def _keep(self, data: bytes) -> None:
        self._waiting.append(data)
        self._size += len(data)

    def _drop(self, data: bytes, *, continued: bool) -> None:
        """Count the lines that begin here; one that was begun before goes on nowhere."""
        begun = data.count(b"\n") + self._open - continued
        self._dropped = begun + (self._dropped or 0)
        self._lost = self._open

    def _begun(self, data: bytes) -> bytes:
        """Return the text from where a line begins, or is overwritten: the one before is missing."""
        end = data.find(b"\n")
        if data.startswith(b"\r"):
            self._lost = False
            return data
        self._lost = end < 0
        return b"" if end < 0 else data[end + 1 :]

    def _confession(self) -> bytes:
        count = max(1, self._dropped or 0)
        text = f"[orchestra] {count} lines are not shown: the screen was too slow; the log files have them\n"
        self._dropped = None
        return (b"\n" if self._cut else b"") + text.encode()

    def _push(self) -> None:
        while self._waiting:
            try:
                written = self._write()
            except BlockingIOError:
                return
            except OSError:  # hung up: nobody sees it any more, and the log files have it
                self._give_up()
                return
            self._size -= written
            self._forget(written)

    def _write(self) -> int:
        """Write what can be written with one call; return how much that was."""
        if not self._careful:
            if len(self._waiting) == 1:
                return os.write(self.descriptor, self._waiting[0])
            return os.writev(self.descriptor, [*islice(self._waiting, _AT_ONCE)])
        poll = select.poll()
        poll.register(self.descriptor, select.POLLOUT)
        if not poll.poll(0):
            raise BlockingIOError
        return os.write(self.descriptor, self._waiting[0][:_CAREFUL_PIECE])

    def _forget(self, written: int) -> None:
        while written and written >= len(self._waiting[0]):
            written -= len(self._waiting.popleft())
        if written:
            self._waiting[0] = memoryview(self._waiting[0])[written:]

    def _give_up(self) -> None:
        self.closed = True
        self._waiting.clear()
        self._size = 0


def _open_anew(descriptor: int) -> tuple[int, bool]:
    """Return a descriptor to write to, and whether it must be written to with care."""
    try:
        if stat.S_ISREG(os.fstat(descriptor).st_mode):
            return descriptor, False
        flags = os.O_WRONLY | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC
        return os.open(f"/proc/self/fd/{descriptor}", flags), False
    except OSError:
        return descriptor, True


def same_file(one: int, other: int) -> bool:
    """Tell whether two descriptors lead to the same terminal, pipe or file."""
    try:
        return os.path.sameopenfile(one, other)
    except OSError:
        return False
