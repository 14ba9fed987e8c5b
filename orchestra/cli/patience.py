"""A limit to the time that code of a launch file may take, in a command that runs it in its own process."""

from __future__ import annotations

import signal
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

from orchestra.cli import boundary, leaving
from orchestra.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

_AGAIN: Final = 2.0  # seconds after which code that goes on all the same is ended with the command


class _TimeIsUp(KeyboardInterrupt):
    """What code sees that has taken too long: it goes through where an interruption does."""


@contextmanager
def patient(seconds: float, file: str) -> Iterator[None]:
    """Let the code of a file take so many seconds and no more. Raises `UsageError` after that."""
    told = f"the code of {file} takes longer than {seconds:g} s (--time-limit)"
    tries = 0

    def interrupt(number: int, frame: FrameType | None) -> None:
        del number, frame
        nonlocal tries
        tries += 1
        if tries > 1:
            sys.stderr.write(f"error: {told}\n")
            leaving.end_at_once(boundary.MISTAKE)
        raise _TimeIsUp

    before = signal.signal(signal.SIGALRM, interrupt)
    signal.setitimer(signal.ITIMER_REAL, seconds, _AGAIN)
    try:
        yield
    except _TimeIsUp:
        raise UsageError(told) from None
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
