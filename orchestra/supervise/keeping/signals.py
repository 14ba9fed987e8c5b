"""Dispositions and masks: what each signal means to a run, and how those that we receive are told.

    SIGINT, SIGTERM, SIGHUP     the run ends; SIGINT again hurries it
    SIGQUIT                     the state of the run is told, and it goes on
    SIGTSTP, SIGCONT            the keeper alone stops and goes on: the shell gets its prompt back
    SIGWINCH                    the terminal has another size
    SIGTTIN, SIGTTOU, others    nothing happens

SIGKILL and SIGSTOP cannot be received (signal(7)), and those that tell a fault of the program itself end it.

A hang-up that is ignored at the start ends nothing of ours: that is how nohup(1) says that a run is to go on when its
terminal is closed. An ignored SIGINT says nothing, since shells give that to every job in the background. Programs
begin with default actions all the same: they have sessions of their own, and no terminal hangs up on them.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

_STOP_SIGNALS = frozenset({signal.SIGINT, signal.SIGTERM, signal.SIGHUP})
_SIG_ERR = -1  # signal(2)
_LEFT_ALONE = frozenset({signal.SIGPIPE, signal.SIGXFSZ})
_FAULTS = frozenset(
    {
        signal.SIGABRT,
        signal.SIGBUS,
        signal.SIGFPE,
        signal.SIGILL,
        signal.SIGSEGV,
        signal.SIGSYS,
        signal.SIGTRAP,
    }
)
_UNRECEIVABLE = frozenset({signal.SIGKILL, signal.SIGSTOP})


def stop_signals() -> frozenset[signal.Signals]:
    """Return the signals that ask for the end of the run."""
    return _STOP_SIGNALS - _kept()


def received_signals() -> frozenset[int]:
    """Return every signal that is received and understood, or disregarded: none of them ends a process of ours."""
    return frozenset(signal.valid_signals()) - _FAULTS - _UNRECEIVABLE - _LEFT_ALONE - _kept()


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
        unblock_signals()


def unblock_signals() -> None:
    """Let every signal through."""
    signal.pthread_sigmask(signal.SIG_SETMASK, ())


def disregard_hang_up() -> None:
    """Where a hang-up is ignored, handle it by doing nothing: execve(2) resets handlers, but leaves ignored signals so.

    The handler is a C function, for one of Python's would be told through the wakeup descriptor like a stop signal.
    getpid(2) may be called there (signal-safety(7)) and changes nothing.
    """
    libc = ctypes.CDLL(None, use_errno=True)
    libc.signal.restype = ctypes.c_ssize_t
    for number in _kept():
        if libc.signal(number, ctypes.cast(libc.getpid, ctypes.c_void_p)) == _SIG_ERR:
            raise OSError(ctypes.get_errno(), f"signal({number})")


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
