"""Dispositions and masks: what a process inherits is not what it needs, with one exception.

A hang-up that is ignored at the start stays ignored, in everything of ours and in the programs: that is how nohup(1)
says that a run is to go on when its terminal is closed. An ignored SIGINT says nothing, since shells give that to
every job in the background.
"""

from __future__ import annotations

import contextlib
import os
import signal

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

_STOP_SIGNALS = frozenset({signal.SIGINT, signal.SIGTERM, signal.SIGHUP})
_LEFT_ALONE = frozenset({signal.SIGPIPE, signal.SIGXFSZ})


def stop_signals() -> frozenset[signal.Signals]:
    """Return the signals that ask for the end of the run."""
    return _STOP_SIGNALS - _kept()


def _kept() -> frozenset[signal.Signals]:
    ignored = signal.getsignal(signal.SIGHUP) == signal.SIG_IGN
    return frozenset({signal.SIGHUP}) if ignored else frozenset()


def reset_signals(*, unblock: bool = True) -> None:
    """Give every signal its default action, but leave an ignored hang-up ignored; unblock them all.

    SIGPIPE and SIGXFSZ stay ignored, as Python has them: a write then fails with an error that can be handled.
    """
    for number in signal.valid_signals() - _LEFT_ALONE - _kept():
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
