"""The process that the user started: it forwards signals, waits, and clears up when the supervisor dies.

It owns the terminal: it alone is in the foreground process group, so that Ctrl-C is heard once. It is a subreaper, so
that whatever the supervisor started becomes its child when the supervisor dies (prctl(2)). It does nothing that can
fail or block: no plan, no logs, no import of user code.

Signals are blocked and fetched with sigtimedwait(2): no handler runs, nothing is lost between two waits, and it makes
no difference that SIGINT was ignored when we were started, as a shell does for a job in the background. An ignored
SIGHUP stays ignored (`signals` says why).
"""

from __future__ import annotations

import contextlib
import os
import select
import signal
import sys
import time

from orchestra.supervise import kernel, proc
from orchestra.supervise.signals import stop_signals

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

# The supervisor ends everything within 5 s of a request and gives up within 6 s. One that has done neither by now is
# stuck itself.
PATIENCE = 8.0

# The supervisor is dead: what it started gets these, each for the time given, 5 s together.
_SWEEP = ((signal.SIGINT, 2.0), (signal.SIGTERM, 1.5), (signal.SIGKILL, 1.5))
_LOOK_AGAIN = 0.05

FAILED, UNSTOPPABLE = 1, 4


def keep(supervise: Callable[[], int]) -> int:
    """Run `supervise` in a child and return its status; 1 where it died of a signal, 4 where something is left."""
    _fill_standard_descriptors()
    kernel.set_name("orc-keeper")
    kernel.become_subreaper()
    for number in _fetched():
        signal.signal(number, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_SETMASK, _fetched())
    supervisor = _fork(supervise)
    status = _wait(supervisor)
    if os.WIFEXITED(status) and os.WEXITSTATUS(status) == UNSTOPPABLE:
        return UNSTOPPABLE  # the supervisor has tried everything, and has named what is left
    left = sweep(os.getpid())
    if os.WIFEXITED(status):
        return UNSTOPPABLE if left else os.WEXITSTATUS(status)
    name = signal.Signals(os.WTERMSIG(status)).name
    say(f"the supervisor was ended by {name}; " + _outcome(left))
    return UNSTOPPABLE if left else FAILED


def _outcome(left: list[int]) -> str:
    if not left:
        return "everything that it had started has been ended"
    return "could not be ended: " + ", ".join(f"{proc.command(pid)} (pid {pid})" for pid in left)


def _fork(supervise: Callable[[], int]) -> int:
    """Start the supervisor: a session of its own, ended by SIGTERM when the keeper dies, whatever way that is."""
    flush()
    keeper = os.getpid()
    pid = os.fork()
    if pid:
        return pid
    status = 3
    try:
        kernel.die_with_parent(signal.SIGTERM, keeper)
        kernel.set_name("orc-supervisor")
        kernel.become_subreaper()
        os.setsid()
        status = supervise()
        flush()
    finally:
        os._exit(status)


def _wait(supervisor: int) -> int:
    """Forward signals until the supervisor has ended; return its wait status."""
    deadline: float | None = None
    while True:
        received = _fetch(None if deadline is None else max(0.0, deadline - time.monotonic()))
        if received is None:
            say(f"the supervisor does not answer; it is killed after {PATIENCE:.0f} s")
            os.kill(supervisor, signal.SIGKILL)
            deadline = None
        elif received in stop_signals():
            os.kill(supervisor, received)
            deadline = deadline or time.monotonic() + PATIENCE
        status = _reap(supervisor)
        if status is not None:
            return status


def _fetched() -> frozenset[signal.Signals]:
    return stop_signals() | {signal.SIGCHLD}


def _fetch(timeout: float | None) -> int | None:
    """Return the next signal, None where the time is over."""
    if timeout is None:
        return signal.sigwaitinfo(_fetched()).si_signo
    received = signal.sigtimedwait(_fetched(), timeout)
    return received.si_signo if received else None


def _reap(supervisor: int | None = None) -> int | None:
    """Collect every child that has ended; return the status of the supervisor if it is among them."""
    status_of_supervisor = None
    while True:
        try:
            pid, status = os.waitpid(-1, os.WNOHANG)
        except ChildProcessError:
            return status_of_supervisor
        if not pid:
            return status_of_supervisor
        if pid == supervisor:
            status_of_supervisor = status


def sweep(root: int) -> list[int]:
    """End every descendant of a process, politely first; return those that are left. A stop signal makes it KILL now.

    Whoever receives it decides nothing: after the last signal only what the kernel itself cannot end is left.
    """
    hurry = False
    for number, seconds in _SWEEP:
        if hurry and number != signal.SIGKILL:
            continue
        deadline = time.monotonic() + seconds
        told: set[int] = set()
        while True:
            _reap()
            left = proc.descendants(root)
            if not left:
                return []
            if time.monotonic() >= deadline:
                break
            for pid in left if number == signal.SIGKILL else set(left) - told:
                _send(pid, number)
            told.update(left)
            hurry = hurry or _fetch(_LOOK_AGAIN) in stop_signals()
            if hurry and number != signal.SIGKILL:
                break
    return proc.descendants(root)


def _send(pid: int, number: int) -> None:
    """Signal a process; a stopped one is woken, since it could not act on it otherwise."""
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.kill(pid, number)
        if number != signal.SIGKILL:
            os.kill(pid, signal.SIGCONT)


def flush() -> None:
    """Write out what Python still holds; either stream may be closed, or nobody may read it."""
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError, ValueError, AttributeError):
            stream.flush()


def _fill_standard_descriptors() -> None:
    """Open what is closed of 0, 1 and 2 on /dev/null, so that no pipe or file of ours gets such a number."""
    while True:
        descriptor = os.open(os.devnull, os.O_RDWR)
        if descriptor > 2:  # noqa: PLR2004 - standard error
            os.close(descriptor)
            return
        os.set_inheritable(descriptor, True)


def say(text: str) -> None:
    """Tell the user something unless that would block: a stuck terminal must not keep anything alive."""
    poll = select.poll()
    with contextlib.suppress(OSError):
        poll.register(2, select.POLLOUT)
        if poll.poll(0):
            os.write(2, f"[orchestra] {text}\n".encode())
