"""Ends everything below a process, whatever it does against that.

Programs get the time to end by themselves. Those that do not are first stopped, then killed: what watches over another
and starts it again cannot do so between the two. Processes that multiply while they are looked for are looked for again
at once, without a pause, until a look finds no new one.
"""

from __future__ import annotations

import contextlib
import os
import signal
import time

from orchestra.supervise.keeping import proc

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable

# The supervisor is dead: what it started gets these, each for the time given, 5 s together.
_POLITE = ((signal.SIGINT, 2.0), (signal.SIGTERM, 1.5))
_KILL = 1.5
_LOOK_AGAIN = 0.05
# How long those that multiply are chased without a pause, in seconds.
_CHASE = 0.3


def sweep(pause: Callable[[float], bool], spared: Collection[int] = ()) -> list[int]:
    """End every descendant of this process, a subreaper, politely first; return those that are left.

    Children that are `spared` stay. `pause` waits so many seconds at most, collects those of our children that have
    ended, and tells whether somebody is in a hurry: then everything is killed now. Whoever receives a signal decides
    nothing: after the last one only what the kernel itself cannot end is left.
    """
    for number, seconds in _POLITE:
        if _asked(number, seconds, pause, spared):
            break
    deadline = time.monotonic() + _KILL
    while not _alone(spared):
        if time.monotonic() >= deadline:
            return [pid for pid in proc.descendants(os.getpid()) if pid not in spared]
        kill_below(os.getpid(), lambda: pause(0.0), spared)
        pause(_LOOK_AGAIN)
    return []


def _alone(spared: Collection[int]) -> bool:
    """Tell whether nothing is below this process, or as far as can be seen nothing but who is spared."""
    return proc.childless() or (bool(spared) and set(proc.children(os.getpid())) <= {*spared})


def _asked(number: int, seconds: float, pause: Callable[[float], bool], spared: Collection[int]) -> bool:
    """Ask each descendant once, and wait for their end; tell whether there is nothing more to wait for.

    That is when all have ended, or somebody is in a hurry.
    """
    deadline = time.monotonic() + seconds
    told: set[int] = {*spared}
    hurry = pause(0.0)
    while not _alone(spared):
        if hurry or time.monotonic() >= deadline:
            return hurry
        left = set(proc.descendants(os.getpid()))
        _tell(left - told, number)
        told |= left
        hurry = pause(_LOOK_AGAIN)
    return True


def kill_below(root: int, collect: Callable[[], object], spared: Collection[int] = ()) -> None:
    """Stop, then kill, every descendant of a process; `collect` reaps those of our children that have ended."""
    deadline = time.monotonic() + _CHASE
    stopped: set[int] = set()
    while (new := set(proc.branch(root)) - stopped - {*spared}) and time.monotonic() < deadline:
        for pid in new:
            _send(pid, signal.SIGSTOP)
        stopped |= new
        collect()
    for pid in stopped:
        _send(pid, signal.SIGKILL)


def reap(awaited: int | None = None) -> int | None:
    """Collect every child that has ended; return the wait status of the one that is awaited if it is among them."""
    status_of_awaited = None
    while True:
        try:
            pid, status = os.waitpid(-1, os.WNOHANG)
        except ChildProcessError:
            return status_of_awaited
        if not pid:
            return status_of_awaited
        if pid == awaited:
            status_of_awaited = status


def _tell(pids: Iterable[int], number: int) -> None:
    """Signal processes; a stopped one is woken, since it could not act on it otherwise."""
    for pid in pids:
        _send(pid, number)
        _send(pid, signal.SIGCONT)


def _send(pid: int, number: int) -> None:
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.kill(pid, number)
