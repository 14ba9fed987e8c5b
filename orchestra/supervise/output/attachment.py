"""What somebody who attaches to a process sees of it and may type: raw bytes, whichever run of the process it is.

A process with a terminal of its own (`emulate_tty`, `stdin`) takes input; of any other the output can be followed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Protocol

    class Typed(Protocol):
        """The input of a program with a terminal."""

        def write(self, data: bytes) -> int:
            """Take bytes as if they were typed; return how many were taken."""

        def resize(self, columns: int, lines: int) -> None:
            """Give the terminal another size."""


# What is kept for whoever does not take it, in bytes; beyond that, the oldest is dropped and counted.
LONGEST_KEPT = 256 * 1024


class Tap:
    """The output of a process from now on, kept until it is taken. `wake` is called when there is something again."""

    def __init__(self, wake: Callable[[], None], leave: Callable[[Tap], None]) -> None:
        self._wake = wake
        self._leave = leave
        self._kept = bytearray()
        self.missed = 0

    def take(self, most: int = LONGEST_KEPT) -> bytes:
        """Return what has come, at most so many bytes; nothing where nothing has. `missed` counts what was dropped."""
        data = bytes(self._kept[:most])
        del self._kept[:most]
        return data

    def close(self) -> None:
        """Take no more."""
        self._leave(self)

    def feed(self, data: bytes) -> None:
        """Keep a piece of output."""
        idle = not self._kept
        self._kept += data
        excess = len(self._kept) - LONGEST_KEPT
        if excess > 0:
            del self._kept[:excess]
            self.missed += excess
        if idle:
            self._wake()


class Attachment:
    """Where to attach to a process; it stays the same when the process is restarted."""

    def __init__(self) -> None:
        self._taps: list[Tap] = []
        self._typed: Typed | None = None

    @property
    def takes_input(self) -> bool:
        """Whether a program with a terminal runs now."""
        return self._typed is not None

    def write(self, data: bytes) -> int:
        """Type something; return how many bytes were taken, none where nothing takes input."""
        return self._typed.write(data) if self._typed else 0

    def resize(self, columns: int, lines: int) -> None:
        """Give its terminal, where it has one, the size of the one on which it is shown."""
        if self._typed:
            self._typed.resize(columns, lines)

    def tap(self, wake: Callable[[], None]) -> Tap:
        """Follow the output from now on; `wake` is called when there is something to take after there was nothing."""
        tap = Tap(wake, self._taps.remove)
        self._taps.append(tap)
        return tap

    def began(self, typed: Typed | None) -> None:
        """A program runs; `typed` where it has a terminal."""
        self._typed = typed

    def ended(self) -> None:
        """Nothing of the program is left."""
        self._typed = None

    def feed(self, data: bytes) -> None:
        """The program has written something."""
        for tap in tuple(self._taps):
            tap.feed(data)
