"""Writes to a pipe or socket as it takes it, and never waits for it."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.supervise.loop import Loop


class Outbox:
    """Owns a non-blocking descriptor to write to.

    `broken` is called, once, when nobody takes anything any more, `drained` when all that had to wait has been taken.
    """

    def __init__(
        self,
        loop: Loop,
        descriptor: int,
        broken: Callable[[OSError], None],
        drained: Callable[[], None] | None = None,
    ) -> None:
        self._loop = loop
        self._descriptor = descriptor
        self._broken = broken
        self._drained = drained
        self._content = bytearray()
        self._registered = False
        self.open = True

    @property
    def waiting(self) -> int:
        """How many bytes have not been taken yet."""
        return len(self._content)

    def send(self, data: bytes) -> None:
        """Write, now or later; nothing where it is closed."""
        if not self.open or not data:
            return
        idle = not self._content
        self._content += data
        if idle:
            self._write()
            if self._content and self.open:
                self._registered = True
                self._loop.on_writable(self._descriptor, self._go_on)

    def close(self) -> None:
        """Give the descriptor back; what has not been taken is lost."""
        if self.open:
            self.open = False
            self._stop_waiting()
            os.close(self._descriptor)

    def _go_on(self) -> None:
        self._write()
        if not self._content and self.open:
            self._stop_waiting()
            if self._drained:
                self._drained()

    def _stop_waiting(self) -> None:
        if self._registered:
            self._registered = False
            self._loop.forget(self._descriptor)

    def _write(self) -> None:
        try:
            del self._content[: os.write(self._descriptor, self._content)]
        except BlockingIOError:
            return
        except OSError as error:
            self._broken(error)
