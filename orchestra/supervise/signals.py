"""Dispositions and masks: what a process inherits is never what it needs."""

from __future__ import annotations

import contextlib
import os
import signal

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable


def reset_signals(*, unblock: bool = True) -> None:
    """Give every signal its default action and unblock them all.

    SIGPIPE and SIGXFSZ stay ignored, as Python has them: a write then fails with an error that can be handled.
    """
    for number in signal.valid_signals() - {signal.SIGPIPE, signal.SIGXFSZ}:
        with contextlib.suppress(OSError, ValueError):  # SIGKILL, SIGSTOP and those of the C library
            signal.signal(number, signal.SIG_DFL)
    if unblock:
        signal.pthread_sigmask(signal.SIG_SETMASK, ())


def receive_signals(numbers: Iterable[int]) -> int:
    """Turn signals into bytes, one each with its number; return the descriptor to read them from."""
    readable, writable = os.pipe()
    os.set_blocking(readable, False)
    os.set_blocking(writable, False)
    signal.set_wakeup_fd(writable, warn_on_full_buffer=False)
    for number in numbers:
        signal.signal(number, _only_wake)
    return readable


def _only_wake(_number: int, _frame: object) -> None:
    """Do nothing: that a handler exists makes the interpreter write the byte."""
