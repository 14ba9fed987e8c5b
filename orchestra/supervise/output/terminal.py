"""The terminal of a running program, from the side where a user would sit."""

from __future__ import annotations

import contextlib
import fcntl
import os
import signal
import struct
import termios
from typing import TYPE_CHECKING, Final

from orchestra.supervise.output.outbox import Outbox

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from orchestra.supervise.loop import Loop

_LOCAL, _CHARACTERS = 3, 6
# What is kept for a program that does not read what is typed, in bytes.
MOST_TYPED: Final = 65536


class Terminal:
    """What is typed to a program goes to the first of its terminals; all of them have one size.

    `drained` is called when everything that was typed has been taken.
    """

    def __init__(
        self, loop: Loop, pid: int, descriptors: Iterable[int], drained: Callable[[], None] | None = None
    ) -> None:
        self._pid = pid
        # Our own, since whoever reads the output closes his at its end.
        self._descriptors = [os.dup(descriptor) for descriptor in descriptors]
        self._outbox = Outbox(
            loop, os.dup(self._descriptors[0]), lambda _error: self._outbox.close(), drained
        )

    def write(self, data: bytes) -> int:
        """Type something; return how many bytes were taken."""
        taken = data[: max(0, MOST_TYPED - self._outbox.waiting)]
        self._outbox.send(taken)
        return len(taken) if self._outbox.open else len(data)

    def resize(self, columns: int, lines: int) -> None:
        """Give the terminal another size, and tell the program so (SIGWINCH)."""
        for descriptor in self._descriptors:
            with contextlib.suppress(OSError):
                set_size(descriptor, columns, lines)
        # The kernel tells only whom a terminal controls.
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(self._pid, signal.SIGWINCH)

    def hang_up(self) -> None:
        """Nobody types any more: what reads lines finds their end, what reads keys is told as by a closed terminal."""
        master = self._descriptors[0]
        with contextlib.suppress(OSError, termios.error):
            modes = termios.tcgetattr(master)
            if modes[_LOCAL] & termios.ICANON:
                # The first may only end an unfinished line.
                self.write(modes[_CHARACTERS][termios.VEOF] * 2)
            else:
                os.killpg(os.tcgetpgrp(master), signal.SIGHUP)

    def close(self) -> None:
        """Give everything back; what has not been read of the input is lost."""
        self._outbox.close()
        descriptors, self._descriptors = self._descriptors, []
        for descriptor in descriptors:
            os.close(descriptor)


def set_size(descriptor: int, columns: int, lines: int) -> None:
    """Set the size of a terminal (ioctl_tty(2)). Raises `OSError`."""
    fcntl.ioctl(descriptor, termios.TIOCSWINSZ, struct.pack("HHHH", lines, columns, 0, 0))


def our_size() -> tuple[int, int]:
    """Return columns and lines of the terminal that we are shown in, else 80 and 24."""
    for descriptor in (1, 2, 0):
        with contextlib.suppress(OSError):
            columns, lines = os.get_terminal_size(descriptor)
            if columns and lines:
                return columns, lines
    return 80, 24
