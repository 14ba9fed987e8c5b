"""Ends what is left when keeper and supervisor are killed both, so that neither could deal with the other's end.

A third process, forked by the keeper while it is small. It waits on both by pidfds and does nothing else. When both are
dead it ends what carries the run's marks and goes; when the run has ended as it should the keeper ends it. One that is
killed is replaced. Its command line is not ours, so that whoever kills all that is called `orchestra` spares it.

Rejected: PR_SET_PDEATHSIG in every program. It can only be asked for in the child itself, which takes a fork(2) with
code of ours in it for each start, five to ten times as much as posix_spawn(3); it is one SIGTERM, which programs may
ignore, and which reaches nothing that they have started themselves.
"""

from __future__ import annotations

import contextlib
import os
import select
import signal

from orchestra.supervise.keeping import kernel
from orchestra.supervise.keeping.signals import unblock_signals

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

_NAME = "orc-guard"
# Whoever kills it more often than this wants none.
_MOST_TIMES = 100
_STANDARD = 3


class Guard:
    """The guard of this process and of its child, the supervisor; `bury` is what it does when both are dead."""

    def __init__(self, supervisor: int, bury: Callable[[], object]) -> None:
        self._supervisor = supervisor
        self._bury = bury
        self._times = 0
        self._pid = 0
        self.renew()

    def renew(self) -> None:
        """Start it, or another one where it has ended. Without one a run is as safe as its two processes are."""
        if (self._pid and not self._gone(os.WNOHANG)) or self._times == _MOST_TIMES:
            return
        self._times += 1
        watched: list[int] = []
        with contextlib.suppress(OSError):
            watched += (os.pidfd_open(pid) for pid in (os.getpid(), self._supervisor))
            self._pid = _forked(watched, self._bury)
        for descriptor in watched:
            os.close(descriptor)

    @property
    def pids(self) -> tuple[int, ...]:
        """Its pid, nothing where there is none."""
        return (self._pid,) if self._pid else ()

    def dismiss(self) -> None:
        """End it: there is nothing to guard any more."""
        if self._pid and not self._gone(os.WNOHANG):
            os.kill(self._pid, signal.SIGKILL)  # it stays ours until it is reaped
            self._gone(0)

    def _gone(self, options: int) -> bool:
        """Tell whether it has ended; whoever collects our children may have done so with it."""
        try:
            if os.waitpid(self._pid, options)[0] != self._pid:
                return False
        except ChildProcessError:
            pass
        self._pid = 0
        return True


def _forked(watched: Iterable[int], bury: Callable[[], object]) -> int:
    pid = os.fork()
    if pid:
        return pid
    try:
        kernel.set_name(_NAME)
        kernel.set_command_line(_NAME)
        os.setsid()
        _let_go({*watched})
        unblock_signals()
        _wait_for_all(watched)
        bury()
    finally:
        os._exit(0)


def _let_go(kept: set[int]) -> None:
    """Hold nothing open but what is needed: the terminal, pipes and locks belong to others."""
    nothing = os.open(os.devnull, os.O_RDWR)
    for number in range(_STANDARD):
        os.dup2(nothing, number)
    for name in os.listdir("/proc/self/fd"):  # noqa: PTH208 - pathlib is slow to import and this runs in the keeper
        if int(name) >= _STANDARD and int(name) not in kept:
            with contextlib.suppress(OSError):  # the one with which this was listed
                os.close(int(name))


def _wait_for_all(watched: Iterable[int]) -> None:
    """Wait until all of these processes have ended."""
    poll = select.poll()
    left = set(watched)
    for descriptor in left:
        poll.register(descriptor, select.POLLIN)
    while left:
        for descriptor, _ in poll.poll():
            poll.unregister(descriptor)
            left.discard(descriptor)
