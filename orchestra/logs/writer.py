"""Writes to files in a thread of its own: a disk that hangs (a network file system, a dying card) must not hold us up.

Nothing else can promise that: regular files are always writable to poll(2), and O_NONBLOCK means nothing to them
(open(2)). The supervisor therefore has two threads. This one runs no code but that of `rotation`, sees no signal, and
waits on a condition, so that it costs nothing while nothing is written.

What waits to be written is bounded. Whoever produces asks `full` first and, where it is, stops reading from its
program, which then waits for its pipe: nothing is lost on a disk that is merely slow. A disk that takes nothing at all
for `STUCK_AFTER` seconds would stop every node, so then what does not fit is dropped, counted, and told in the files.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections import deque
from typing import TYPE_CHECKING, Final

from orchestra.logs.rotation import Appended

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextlib import AbstractContextManager
    from pathlib import Path

    from orchestra.logs.rotation import Form, Rotation

# Above the first nothing more is produced, below the second it is again; in bytes.
MOST: Final = 8 * 1024 * 1024
FEW: Final = 2 * 1024 * 1024
# In seconds.
STUCK_AFTER: Final = 2.0

# What comes within this time after a write is written with the next one, in seconds: waking for each line of a robot
# that says a thousand in a second costs more than the lines. Behind a large write it is shorter, since more is on its
# way. So much is written sooner, in bytes: with each call this thread has to wait until the other one pauses.
_TOGETHER: Final = 0.01
_BEHIND_MUCH: Final = 0.002
_MUCH: Final = 256 * 1024
_PLENTY: Final = 3 * 1024 * 1024
# From no size on.
_NEVER: Final = sys.maxsize

_CLOSE: Final = -1


class LogFile:
    """A file to append to, now or later."""

    def __init__(self, writer: Writer, file: Appended) -> None:
        self._writer = writer
        self._file = file
        self._begun = False

    @property
    def lost(self) -> int:
        """The number of bytes that could not be written."""
        return self._file.lost

    def write(self, data: bytes) -> None:
        """Append data."""
        if data:
            self._begun = True
            self._writer.add(self._file, data)

    def close(self) -> None:
        """Close the file when everything is written; writing opens it again."""
        if self._begun:
            self._begun = False
            self._writer.add(self._file, _CLOSE)


class Writer:
    """The thread and what it has to do. `descriptor` can be read when `attend` is to be called.

    `failed` hears, within `attend` and `finish`, of each file that cannot be written, at every write that fails.
    """

    def __init__(self, failed: Callable[[Path, OSError], None]) -> None:
        self.descriptor = os.eventfd(0, os.EFD_NONBLOCK | os.EFD_CLOEXEC)
        self._failed = failed
        self._files: list[Appended] = []
        self._failures: deque[tuple[Path, OSError]] = deque(maxlen=100)
        self._changed = threading.Condition()
        # All below is guarded by the condition. A positive number stands for so many bytes that were dropped.
        self._waiting: dict[Appended, list[bytes | int]] = {}
        self._size = 0
        self._dropped = 0
        self._steps = 0
        self._wanted = False
        self._stuck = False
        self._over = False
        self._awaited = False
        self._written = 0
        # From so many waiting bytes on, the thread is woken.
        self._wake_from = _NEVER
        self._resumed: list[Callable[[], None]] = []
        self._thread = threading.Thread(target=self._work, name="orc-writer", daemon=True)
        self._thread.start()

    def file(self, path: Path, rotation: Rotation, form: Form) -> LogFile:
        """Return a file to write to; it comes about with the first text."""
        file = Appended(path, rotation, form, self._took)
        self._files.append(file)
        return LogFile(self, file)

    @property
    def lost(self) -> int:
        """The number of bytes that no file has, those that wait for a disk that hangs included."""
        return sum(file.lost for file in self._files) + self._size + self._dropped

    def together(self) -> AbstractContextManager[object]:
        """Let the thread begin only with the last of several texts: each time it wakes costs more than a short text."""
        return self._changed

    @property
    def full(self) -> bool:
        """Whether nothing more should be produced for now."""
        return self._size > MOST and not self._stuck

    @property
    def steps(self) -> int:
        """A number that grows whenever the disk has taken something."""
        return self._steps

    def add(self, file: Appended, data: bytes | int) -> None:
        """Have something written, or the file closed."""
        with self._changed:
            waiting = self._waiting.setdefault(file, [])
            if isinstance(data, bytes):
                if self._stuck and self._size > MOST:
                    _drop(waiting, len(data))
                    self._dropped += len(data)
                    return
                self._size += len(data)
            waiting.append(data)
            if self._size >= self._wake_from:
                self._wake_from = _NEVER
                self._changed.notify_all()

    def when_room(self, resume: Callable[[], None]) -> None:
        """Call, once, when more may be produced."""
        with self._changed:
            self._resumed.append(resume)
            self._wanted = True
            if self._size <= FEW:
                self._call()

    def give_up(self) -> None:
        """Let producers go on although the disk takes nothing: what does not fit is dropped until it does again."""
        with self._changed:
            self._stuck = self._wanted = True
        self._resume()

    def attend(self) -> None:
        """Do what the thread has called for."""
        os.eventfd_read(self.descriptor)
        self._tell()
        if self._size <= FEW:
            self._stuck = False
            self._resume()

    def finish(self, patience: float, most: float) -> bool:
        """Wait until everything is written; tell whether it is.

        The disk must take something every `patience` seconds, and everything within `most` seconds. What failed until
        then is told here: at the end of a run nobody may be left to call `attend`.
        """
        with self._changed:
            rounds = max(1, round(most / patience))
            self._awaited = True
            self._changed.notify_all()
            while self._size and rounds:
                before = self._steps
                done = self._changed.wait_for(lambda: not self._size, patience)
                rounds = rounds - 1 if done or self._steps != before else 0
            written = not self._size
            self._awaited = False
        self._tell()
        return written

    def close(self) -> None:
        """End the thread when it has nothing to do any more; one that hangs ends with the process."""
        with self._changed:
            self._over = True
            self._changed.notify_all()
        self._thread.join(0 if self._size else None)
        if not self._thread.is_alive():
            os.close(self.descriptor)

    def _work(self) -> None:
        signal.pthread_sigmask(signal.SIG_BLOCK, signal.valid_signals())
        while batch := self._next():
            for file, data in batch.items():
                self._write(file, data)

    def _next(self) -> dict[Appended, list[bytes | int]]:
        with self._changed:
            self._wake_from = _PLENTY
            pause = _BEHIND_MUCH if self._written > _MUCH else _TOGETHER
            self._changed.wait_for(lambda: self._size >= _PLENTY or self._awaited or self._over, pause)
            self._wake_from = 0
            self._changed.wait_for(lambda: self._waiting or self._over)
            self._wake_from = _NEVER
            batch, self._waiting = self._waiting, {}
            self._written = self._size
            return batch

    def _write(self, file: Appended, data: list[bytes | int]) -> None:
        """Write what is there for a file, in as few calls as its gaps allow."""
        together: list[bytes] = []
        for item in (*data, None):
            if isinstance(item, bytes):
                together.append(item)
                continue
            if together:
                self._append(file, together)
                together = []
            if item == _CLOSE:
                file.close()
            elif item:
                file.lose(item)
                with self._changed:
                    self._dropped -= item

    def _append(self, file: Appended, pieces: list[bytes]) -> None:
        error = file.append(pieces)
        with self._changed:
            self._size -= sum(map(len, pieces))
            if error:
                self._failures.append((file.path, error))
            if error or (self._wanted and self._size <= FEW):
                self._call()
            if self._awaited:
                self._changed.notify_all()

    def _tell(self) -> None:
        while self._failures:
            self._failed(*self._failures.popleft())

    def _took(self) -> None:
        self._steps += 1

    def _call(self) -> None:
        os.eventfd_write(self.descriptor, 1)

    def _resume(self) -> None:
        with self._changed:
            resumed, self._resumed = self._resumed, []
            self._wanted = self._stuck
        for resume in resumed:
            resume()


def _drop(waiting: list[bytes | int], size: int) -> None:
    if waiting and isinstance(waiting[-1], int) and waiting[-1] >= 0:
        waiting[-1] += size
    else:
        waiting.append(size)
