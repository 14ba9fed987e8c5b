"""Signals to the supervisor, as they come through the descriptor that the interpreter writes them to."""

from __future__ import annotations

import os
import signal
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.supervise.loop import Loop


class Attention:
    """Hands signals on to whom they concern at the time: `on_stop` and `on_child` change as the run goes on."""

    def __init__(self, loop: Loop, descriptor: int, on_stop: Callable[[int], None]) -> None:
        self.on_stop = on_stop
        self.on_child: Callable[[], None] | None = None
        self._descriptor = descriptor
        loop.on_readable(descriptor, self._read)

    def _read(self) -> None:
        received = os.read(self._descriptor, 4096)
        if signal.SIGCHLD in received and self.on_child:
            self.on_child()
        for number in received:
            if number != signal.SIGCHLD:
                self.on_stop(number)
