"""One output stream of a running program, read as it comes: one read a round, so that nobody starves the others."""

from __future__ import annotations

import contextlib
import fcntl
import os
from typing import TYPE_CHECKING

from orchestra.logs.lines import Lines

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.supervise.loop import Loop, Timer
    from orchestra.supervise.output.intake import Intake

# Read at a time, in bytes: what a pipe holds. One that was at least half full has more room from then on, since each
# read and the round that leads to it take as long as writing some hundred lines.
_READ_SIZE = 65536
_LARGE = 262144
# Where lines are shorter than the first on average, the second is enough of them: each becomes a record of more than a
# hundred bytes, and the records of what is read at a time are made together.
_SHORT = 32
_FEW = 16384
# More than anything that is made of what is read at a time. The allocator of glibc maps what is larger than 128 KiB
# anew each time, and the kernel fills it with zeros, which takes as long as all of our own work; once something of this
# size has been given back it keeps as much (mallopt(3), M_MMAP_THRESHOLD).
_TO_KEEP = 4 * 1024 * 1024
# More than a terminal holds: its buffers take 64 KiB and a page.
_TERMINAL_HOLDS = 131072
# A line without an end, such as a question or a progress bar, is shown after this time, in seconds.
_FLUSH_AFTER = 0.1


class Stream:
    """Reads a descriptor, which it owns, and hands on what it gets: whole lines, or what has stood for a while.

    `tapped` gets the bytes as they come, after the lines that they complete have been delivered. With an `intake` it is
    read no faster than that allows.
    """

    def __init__(
        self,
        loop: Loop,
        descriptor: int,
        deliver: Callable[[bytes], None],
        tapped: Callable[[bytes], None] | None = None,
        intake: Intake | None = None,
    ) -> None:
        self._loop = loop
        self._descriptor = descriptor
        self._deliver = deliver
        self._tapped = tapped
        self._intake = intake
        self._size = self._next_size = _READ_SIZE
        self._lines = Lines()
        self._timer: Timer | None = None
        self._open = True
        self._listening = True
        loop.on_readable(descriptor, self._readable)

    def drain(self) -> None:
        """Read what is there now, and no more, should somebody keep on writing."""
        rest = self._most() if self._open else 0
        while self._open and rest > 0:
            size = self._read()
            rest = rest - size if size else 0

    def part(self) -> None:
        """Read what is there; where somebody still holds the other end, go on until he does not."""
        self.drain()
        if self._open and self._intake:
            self._intake.leave(self)
        else:
            self.close()

    def close(self) -> None:
        """Read what is there, hand on everything, and close the descriptor."""
        self.drain()
        self._end()

    def _most(self) -> int:
        """Return how much can be there now (pipe(7), pty(7))."""
        try:
            return fcntl.fcntl(self._descriptor, fcntl.F_GETPIPE_SZ)
        except OSError:
            return _TERMINAL_HOLDS

    def _readable(self) -> None:
        if self._intake and self._intake.full:
            self._loop.forget(self._descriptor)
            self._listening = False
            self._intake.wait(self._go_on)
        else:
            self._read()

    def _go_on(self) -> None:
        if self._open and not self._listening:
            self._listening = True
            self._loop.on_readable(self._descriptor, self._readable)

    def _read(self) -> int:
        """Read once; return how many bytes there were."""
        try:
            data = os.read(self._descriptor, self._next_size)
        except BlockingIOError:
            return 0
        except OSError:  # a terminal whose other side is closed says EIO where a pipe has an end (pty(7))
            data = b""
        if not data:
            self._end()
            return 0
        if 2 * len(data) >= self._next_size:
            self._enlarge()
            self._next_size = self._size if data.count(b"\n") * _SHORT <= len(data) else _FEW
        lines = self._lines.feed(data)
        if lines:
            self._deliver(lines)
        if self._tapped:
            self._tapped(data)
        self._see_to_timer()
        return len(data)

    def _enlarge(self) -> None:
        """Let a busy pipe hold more; a terminal has one size, and a user's pipes have one limit (pipe(7))."""
        if self._size < _LARGE:
            self._size = _LARGE
            bytes(_TO_KEEP)  # its pages are never touched
            with contextlib.suppress(OSError):
                fcntl.fcntl(self._descriptor, fcntl.F_SETPIPE_SZ, _LARGE)

    def _end(self) -> None:
        if not self._open:
            return
        self._open = False
        if self._listening:
            self._loop.forget(self._descriptor)
        os.close(self._descriptor)
        if self._intake:
            self._intake.forget(self)
        self._cancel_timer()
        rest = self._lines.close()
        if rest:
            self._deliver(rest)

    def _see_to_timer(self) -> None:
        if not self._lines.unfinished:
            self._cancel_timer()
        elif self._timer is None:
            self._timer = self._loop.call_later(_FLUSH_AFTER, self._flush)

    def _cancel_timer(self) -> None:
        if self._timer:
            self._timer.cancel()
            self._timer = None

    def _flush(self) -> None:
        self._timer = None
        begun = self._lines.flush()
        if begun:
            self._deliver(begun)


def as_text(deliver: Callable[[str], None]) -> Callable[[bytes], None]:
    """Return what a stream may deliver to, for who wants text; bytes that are none are lone surrogates (PEP 383)."""

    def decoded(data: bytes) -> None:
        deliver(data.decode("utf-8", "surrogateescape"))

    return decoded
