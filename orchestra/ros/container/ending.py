"""Ends the container on SIGINT and SIGTERM, with the context as it is: components say good-bye to others.

The handlers of rclpy would shut the context down first. A signal does not wake a thread that waits for messages, so
another one waits for the byte that Python's own handler writes at once.
"""

from __future__ import annotations

import os
import signal
import threading
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType

_SIGNALS: Final = (signal.SIGINT, signal.SIGTERM)


class Ending:
    """Calls what it is given with the first signal, at once where that has come before. The next one kills."""

    def __init__(self) -> None:
        self._come = threading.Event()
        reading, writing = os.pipe2(os.O_CLOEXEC | os.O_NONBLOCK)
        os.set_blocking(reading, True)
        signal.set_wakeup_fd(writing, warn_on_full_buffer=False)
        for number in _SIGNALS:
            signal.signal(number, self._note)
        threading.Thread(target=self._wait, args=(reading,), daemon=True).start()
        self._lock = threading.Lock()
        self._then: Callable[[], None] | None = None

    def then(self, end: Callable[[], None]) -> None:
        """Call this with the first signal."""
        with self._lock:
            self._then = end
        if self._come.is_set():
            end()

    def _wait(self, reading: int) -> None:
        while os.read(reading, 1)[0] not in _SIGNALS:
            continue
        self._come.set()
        with self._lock:
            end = self._then
        if end is not None:
            end()

    def _note(self, _number: int, _frame: FrameType | None) -> None:
        for number in _SIGNALS:
            signal.signal(number, signal.SIG_DFL)
