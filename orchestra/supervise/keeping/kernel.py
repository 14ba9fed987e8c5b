"""Requests to Linux that the standard library has no call for."""

from __future__ import annotations

import ctypes
import os

# From linux/prctl.h.
_SET_PDEATHSIG = 1
_SET_NAME = 15
_SET_CHILD_SUBREAPER = 36
# From asm-generic/resource.h; `resource` has no name for it.
LOCKS = 10
# Fields 48 and 49 of /proc/PID/stat, counted behind the name: where the words of the command line begin and end.
_ARG_START = 45
# From linux/signal.h.
_SS_DISABLE = 2

_LIBC = ctypes.CDLL(None, use_errno=True)


def become_subreaper() -> None:
    """Make this process the parent of every descendant that loses its own (prctl(2), PR_SET_CHILD_SUBREAPER)."""
    _prctl(_SET_CHILD_SUBREAPER, 1)


def die_with_parent(signal_number: int, parent: int) -> None:
    """Ask for a signal when the parent ends; end at once where it has ended before we could ask.

    The signal comes when the *thread* that forked ends (prctl(2), PR_SET_PDEATHSIG), so fork from the main thread.
    """
    _prctl(_SET_PDEATHSIG, signal_number)
    if os.getppid() != parent:
        os._exit(1)


def set_name(name: str) -> None:
    """Set what `ps -o comm` shows: at most 15 bytes."""
    buffer = ctypes.create_string_buffer(name.encode()[:15])
    _prctl(_SET_NAME, ctypes.addressof(buffer))


def set_command_line(text: str) -> None:
    """Set what /proc/PID/cmdline has, and so `ps` and `pkill -f`: the memory in which our words came (proc(5)).

    What is longer than these were is cut.
    """
    with open("/proc/self/stat", "rb") as file:  # noqa: PTH123 - pathlib is slow to import and this runs in the keeper
        begin, end = map(int, file.read().rpartition(b")")[2].split()[_ARG_START : _ARG_START + 2])
    size = end - begin
    if size > 0:
        ctypes.memmove(begin, text.encode()[: size - 1].ljust(size, b"\0"), size)


class _Limit(ctypes.Structure):
    _fields_ = (("soft", ctypes.c_uint64), ("hard", ctypes.c_uint64))


def set_lock_limit(number: int) -> None:
    """Set the soft limit on file locks of this process, which all that it starts inherits and which limits nothing.

    Where the hard limit is lower it stays as it is: whoever looks for the number has other ways.
    """
    limit = _Limit()
    _LIBC.prlimit64(0, LOCKS, None, ctypes.byref(limit))
    limit.soft = min(number, limit.hard)
    _LIBC.prlimit64(0, LOCKS, ctypes.byref(limit), None)


class _Stack(ctypes.Structure):
    _fields_ = (("base", ctypes.c_void_p), ("flags", ctypes.c_int), ("size", ctypes.c_size_t))


def handle_signals_on_the_ordinary_stack() -> None:
    """Give up the alternate signal stack of this thread (sigaltstack(2)).

    It is small, and a burst of signals, whose handlers interrupt each other, overflows it.
    """
    if _LIBC.sigaltstack(ctypes.byref(_Stack(None, _SS_DISABLE, 0)), None):
        code = ctypes.get_errno()
        raise OSError(code, f"sigaltstack: {os.strerror(code)}")


def _prctl(option: int, value: int) -> None:
    if _LIBC.prctl(option, ctypes.c_ulong(value), 0, 0, 0):
        code = ctypes.get_errno()
        raise OSError(code, f"prctl({option}): {os.strerror(code)}")
