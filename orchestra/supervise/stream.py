"""One output stream of a running program, read as it comes."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.logs.lines import Lines

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.supervise.loop import Loop, Timer

_READ_SIZE = 65536
# More than any pipe or terminal holds, and an end for one that somebody keeps on filling.
_MOST_READS = 64
# A line without an end, such as a question or a progress bar, is shown after this time, in seconds.
_FLUSH_AFTER = 0.1


class Stream:
    """Reads a descriptor whenever it can be read and hands on text: whole lines, or what has stood for a while.

    `tapped` gets the bytes as they come, after the text that they complete has been delivered.
    """

    def __init__(
        self,
        loop: Loop,
        descriptor: int,
        deliver: Callable[[str], None],
        tapped: Callable[[bytes], None] | None = None,
    ) -> None:
        self._loop = loop
        self._descriptor = descriptor
        self._deliver = deliver
        self._tapped = tapped
        self._lines = Lines()
        self._timer: Timer | None = None
        self._open = True
        loop.on_readable(descriptor, self.read)

    def read(self) -> bool:
        """Read once; tell whether there was something."""
        try:
            data = os.read(self._descriptor, _READ_SIZE)
        except BlockingIOError:
            return False
        except OSError:  # a terminal whose other side is closed says EIO where a pipe has an end (pty(7))
            data = b""
        if not data:
            self._stop_reading()
            return False
        text = self._lines.feed(data)
        if text:
            self._deliver(text)
        if self._tapped:
            self._tapped(data)
        self._see_to_timer()
        return True

    def drain(self) -> None:
        """Read what is there now."""
        for _ in range(_MOST_READS):
            if not self._open or not self.read():
                return

    def close(self) -> None:
        """Read what is there, and hand on everything. The descriptor belongs to the child."""
        self.drain()
        self._stop_reading()
        self._cancel_timer()
        text = self._lines.close()
        if text:
            self._deliver(text)

    def _stop_reading(self) -> None:
        if self._open:
            self._open = False
            self._loop.forget(self._descriptor)

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
        text = self._lines.flush()
        if text:
            self._deliver(text)
