"""Signals to the supervisor, as they come through the descriptor that the interpreter writes them to."""

from __future__ import annotations

import os
import signal
from typing import TYPE_CHECKING

from orchestra.supervise.keeping.signals import stop_signals

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.supervise.loop import Loop


class Attention:
    """Hands signals on to whom they concern at the time; who that is changes as the run goes on.

    `on_suspend` hears that the keeper stops, so that the terminal is the shell's again, `on_resume` that it goes on,
    perhaps in the background; `on_resize` that the terminal may have another size. What nobody hears changes nothing.
    """

    def __init__(self, loop: Loop, descriptor: int, on_stop: Callable[[int], None]) -> None:
        self.on_stop = on_stop
        self.on_child: Callable[[], None] = _nobody
        self.on_dump: Callable[[], None] = _nobody
        self.on_resize: Callable[[], None] = _nobody
        self.on_suspend: Callable[[], None] = _nobody
        self.on_resume: Callable[[], None] = _nobody
        self._stop_signals = stop_signals()
        self._descriptor = descriptor
        loop.on_readable(descriptor, self._read)

    def _read(self) -> None:
        received = os.read(self._descriptor, 4096)
        # However many children have ended, one look finds them all; the same holds for the terminal's size.
        if signal.SIGCHLD in received:
            self.on_child()
        if signal.SIGWINCH in received or signal.SIGCONT in received:
            self.on_resize()
        for number in received:
            self._tell(number)

    def _tell(self, number: int) -> None:
        if number in self._stop_signals:
            self.on_stop(number)
        elif number == signal.SIGQUIT:
            self.on_dump()
        elif number == signal.SIGTSTP:
            self.on_suspend()
        elif number == signal.SIGCONT:
            self.on_resume()


def _nobody() -> None:
    """Where nobody is concerned."""
