"""Writes messages to a client as it takes them, and gives it up where it does not."""

from __future__ import annotations

import os
from collections import deque
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import socket
    from collections.abc import Callable

    from orchestra.supervise.loop import Loop

# What is kept for a client that does not read, in bytes; the kernel keeps some 200 kB more.
BACKLOG = 1024 * 1024


class Outlet:
    """The way to one client. `broken` is called, once, with the reason why nothing reaches it any more.

    `drained` is called whenever everything that had to wait has been taken.
    What waits is shared: the same event for a hundred clients is there once.
    """

    def __init__(self, loop: Loop, connection: socket.socket, broken: Callable[[str], None]) -> None:
        self.drained: Callable[[], None] | None = None
        self._loop = loop
        self._connection = connection
        self._broken = broken
        self._waiting: deque[bytes | memoryview] = deque()
        self._size = 0
        self._watched: int | None = None
        self._open = True

    @property
    def pending(self) -> int:
        """The number of bytes that the client has not taken yet."""
        return self._size

    def send(self, message: bytes) -> None:
        """Write now what the client takes, and keep the rest."""
        if not self._open:
            return
        if self._waiting and self._size + len(message) > BACKLOG:
            self._give_up("it does not read what it is sent")
            return
        self._waiting.append(message)
        self._size += len(message)
        if len(self._waiting) == 1:
            self.push()

    def push(self) -> None:
        """Write what the client takes now."""
        while self._waiting and self._open:
            message = self._waiting[0]
            try:
                written = self._connection.send(message)
            except BlockingIOError:
                break
            except OSError as error:
                self._give_up(error.strerror or str(error))
                return
            self._size -= written
            if written == len(message):
                self._waiting.popleft()
            else:
                self._waiting[0] = memoryview(message)[written:]
        self._watch()

    def close(self) -> None:
        """Send nothing more. The connection belongs to the caller."""
        self._open = False
        self._waiting.clear()
        self._size = 0
        self._watch()

    def _watch(self) -> None:
        """Wait for room while something waits: on a descriptor of our own, since the connection's is read from."""
        if self._waiting and self._watched is None:
            try:
                self._watched = os.dup(self._connection.fileno())
            except (
                OSError
            ) as error:  # no descriptor is left: better without this client than without a process
                self._give_up(error.strerror or str(error))
                return
            self._loop.on_writable(self._watched, self.push)
        elif not self._waiting and self._watched is not None:
            self._loop.forget(self._watched)
            os.close(self._watched)
            self._watched = None
            if self._open and self.drained:
                self.drained()

    def _give_up(self, reason: str) -> None:
        self.close()
        self._broken(reason)
