"""Limits of a process, put in force in its own process before its program begins, so that it never runs without them.

What is not written stays as it is inherited. Real-time scheduling and niceness go on to all threads and children, as
with chrt(1) and nice(1): a node's middleware works in threads of its own, so SCHED_RESET_ON_FORK, which keeps even
threads from it, would leave only the main thread in real time (sched(7)).

Where the kernel groups processes by session (sched(7), "The autogroup feature"), niceness counts only inside of a
session, and every process of a plan has its own. So the session gets the same niceness. The kernel takes one such
request in a tenth of a second from those without privileges (kernel/sched/autogroup.c), so that one may have to wait.
"""

from __future__ import annotations

import errno
import os
import resource
from typing import TYPE_CHECKING

from orchestra.supervise.limits.caps import enter
from orchestra.supervise.limits.cgroups import write

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from orchestra.values import Limits

POLICIES = {
    "other": os.SCHED_OTHER,
    "batch": os.SCHED_BATCH,
    "idle": os.SCHED_IDLE,
    "fifo": os.SCHED_FIFO,
    "rr": os.SCHED_RR,
}
REAL_TIME = ("fifo", "rr")
RLIMITS = {
    name.removeprefix("RLIMIT_").lower(): number
    for name, number in vars(resource).items()
    if name.startswith("RLIMIT_") and name != "RLIMIT_OFILE"  # the old name of another
}
UNLIMITED = resource.RLIM_INFINITY
# The permissions to be fast come before what they permit; the rest comes last, since it may leave us nothing to do.
_PERMISSIONS = ("nice", "rtprio", "rttime")


def restriction(limits: Limits, group: str | None, place: str) -> Callable[[], None]:
    """Return what puts limits in force in the process that calls it; `group` is the folder of its memory cap.

    What it returns raises `OSError` with the limit that is refused as its text, and with `place` as its file.
    """
    steps: list[tuple[str, Callable[[], object]]] = []
    if group is not None:
        steps.append((f"memory cap of {limits.memory} bytes", lambda: enter(group)))
    early = [name for name in limits.rlimits if name in _PERMISSIONS]
    steps.extend(_rlimits(limits, early))
    if limits.cores is not None:
        cores = limits.cores
        steps.append((f"cores {listed(cores)}", lambda: os.sched_setaffinity(0, cores)))
    if limits.nice is not None:
        nice = limits.nice
        steps.append((f"niceness {nice}", lambda: os.setpriority(os.PRIO_PROCESS, 0, nice)))
    if limits.scheduler is not None:
        words = limits.scheduler + (f" with priority {limits.priority}" if limits.priority else "")
        parameters = os.sched_param(limits.priority or 0)
        policy = POLICIES[limits.scheduler]
        steps.append((f"scheduler {words}", lambda: os.sched_setscheduler(0, policy, parameters)))
    steps.extend(_rlimits(limits, [name for name in limits.rlimits if name not in early]))

    def restrict() -> None:
        for what, step in steps:
            try:
                step()
            except (OSError, ValueError) as error:  # ValueError: a hard limit above the present one
                number = getattr(error, "errno", None) or errno.EPERM
                raise OSError(number, f"{what} refused: {os.strerror(number)}", place) from error

    return restrict


def settle_session(pid: int, nice: int) -> bool:
    """Give the session of a process a niceness among sessions; tell whether that is settled (False: try again)."""
    try:
        write(f"/proc/{pid}/autogroup", str(nice))
    except BlockingIOError:
        return False
    except OSError:  # it has ended, the kernel has no autogroups, or permits it to others only
        return True
    return True


def listed(numbers: Iterable[int]) -> str:
    """Return numbers for people: 0, 2, 3."""
    return ", ".join(map(str, numbers))


def _rlimits(limits: Limits, names: Iterable[str]) -> list[tuple[str, Callable[[], object]]]:
    return [
        (f"limit {name} of {_words(limits.rlimits[name])}", _rlimit(name, limits.rlimits[name]))
        for name in names
    ]


def _rlimit(name: str, values: tuple[int, ...]) -> Callable[[], object]:
    soft, hard = values
    return lambda: resource.setrlimit(RLIMITS[name], (soft, hard))


def _words(values: tuple[int, ...]) -> str:
    soft, hard = ("unlimited" if value == UNLIMITED else str(value) for value in values)
    return soft if soft == hard else f"{soft} (hard {hard})"
