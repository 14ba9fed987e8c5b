"""Ending on a signal, between two waits.

An exception that a handler raises while a message is converted comes out of the C++ of rclpy as another one, so the
handlers only note the signal. A second one ends at once what does not come to a wait.
"""

from __future__ import annotations

import signal
import sys
from contextlib import suppress
from typing import TYPE_CHECKING, Final, Self

if TYPE_CHECKING:
    from types import FrameType, TracebackType

_SIGNALS: Final = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
_STATUS: Final = 128
# Seconds that leaving the graph may take: some hundredths, a second on a busy machine.
_LONGEST: Final = 10.0


class Ending:
    """Notes signals while it is entered."""

    def __init__(self) -> None:
        self._noted: int | None = None
        self._before: dict[int, object] = {}
        self._timer: tuple[float, float] | None = None

    def __enter__(self) -> Self:
        for number in _SIGNALS:
            if number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN:  # as nohup has it
                self._before[number] = signal.signal(number, self._note)
        return self

    def __exit__(
        self, _kind: type[BaseException] | None, _error: BaseException | None, _trace: TracebackType | None
    ) -> None:
        if self._timer is not None:
            signal.setitimer(signal.ITIMER_REAL, 0)
        for number, handler in self._before.items():
            signal.signal(number, handler)  # type: ignore[arg-type]  # what it has returned
        if self._timer is not None:
            signal.setitimer(signal.ITIMER_REAL, *self._timer)

    def leave(self) -> None:
        """Let the next signal end this process by itself, until this is left: what comes may not come back to Python.

        A participant that is given back while others come or go can hold the interpreter up for good
        (eProsima/Fast-DDS#6513). So SIGALRM ends the process where nobody else does within 10 s.
        """
        with suppress(OSError):  # which whoever writes the rest is told of
            sys.stdout.flush()
        self._before[signal.SIGALRM] = signal.getsignal(signal.SIGALRM)
        for number in self._before:
            signal.signal(number, signal.SIG_DFL)
        self._timer = signal.setitimer(signal.ITIMER_REAL, _LONGEST)

    def check(self) -> None:
        """Raise `KeyboardInterrupt`, or `SystemExit` with the status for another signal, where one has come."""
        if self._noted is not None:
            number, self._noted = self._noted, None
            self._end(number)

    def _note(self, number: int, _frame: FrameType | None) -> None:
        if self._noted is not None:
            self._end(number)
        self._noted = number

    def _end(self, number: int) -> None:
        if number == signal.SIGINT:
            raise KeyboardInterrupt
        raise SystemExit(_STATUS + number)
