"""What can still be learnt about a program that has just ended: from its last lines, the kernel, and its limits."""

from __future__ import annotations

import resource
import signal
from typing import TYPE_CHECKING

from orchestra.supervise.crash import kernel_log
from orchestra.supervise.crash.causes import meaning, telling_lines
from orchestra.supervise.crash.cores import Core, Victim, core_of
from orchestra.supervise.crash.dossier import Cause, Resources
from orchestra.supervise.limits.applied import RLIMITS
from orchestra.supervise.process.ending import signal_name

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.plan.model import Process
    from orchestra.supervise.limits.confines import Confines
    from orchestra.supervise.process.child import Child
    from orchestra.supervise.process.ending import Ending

# The signals for which the kernel writes a core file (signal(7)).
_DUMPING = frozenset(
    {
        signal.SIGQUIT,
        signal.SIGILL,
        signal.SIGTRAP,
        signal.SIGABRT,
        signal.SIGBUS,
        signal.SIGFPE,
        signal.SIGSEGV,
        signal.SIGXCPU,
        signal.SIGXFSZ,
        signal.SIGSYS,
    }
)
_SIGNALLED = 128
_KILLED = (signal.SIGKILL, _SIGNALLED + signal.SIGKILL)
_MEGABYTE = 1 << 20
_KILOBYTE = 1 << 10


def cause_of(
    process: Process,
    ending: Ending,
    child: Child | None,
    lines: Sequence[str],
    since: float,
    confines: Confines,
) -> Cause:
    """Return why a program ended; `since` is when it began, in seconds of the monotonic clock."""
    said: list[str] = []
    if child and ending.hang is None and ending.signal in {*_DUMPING, signal.SIGKILL}:
        said = kernel_log.about(child.pid, since, kernel_log.recent())
    return Cause(
        ending=str(ending),
        meaning=meaning(ending),
        code=ending.code,
        signal=None if ending.signal is None else signal_name(ending.signal),
        reason=ending.reason,
        hang=ending.hang,
        core_dumped=bool(child and child.dumped),
        out_of_memory=_out_of_memory(process, ending, said, confines),
        evidence=(*telling_lines(lines), *(f"kernel: {line}" for line in said)),
    )


def core_file(process: Process, ending: Ending, child: Child | None, program: str, cwd: str) -> Core | None:
    """Return where its core file is, or how to get one; None where an ending leaves none."""
    if child is None or ending.signal not in _DUMPING:
        return None
    limit = limits_in_force(process)["core"][0]
    return core_of(Victim(child.pid, program, cwd, ending.signal, limit, child.dumped))


def resources_of(process: Process, child: Child | None, confines: Confines) -> Resources:
    """Return what a program has used, as far as the kernel tells (getrusage(2)).

    Until its program begins a child has the memory of its parent, and that counts: up to there nothing can be told.
    """
    cap = confines.cap(process.id)
    capped = cap.peak if cap else None
    usage = child.usage if child else None
    if usage is None:
        return Resources(None, at_most=False, capped_peak=capped, user_time=None, system_time=None)
    ours = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return Resources(
        peak_memory=usage.ru_maxrss * _KILOBYTE,
        at_most=usage.ru_maxrss <= ours,
        capped_peak=capped,
        user_time=usage.ru_utime,
        system_time=usage.ru_stime,
    )


def limits_in_force(process: Process) -> dict[str, tuple[int, int]]:
    """Return soft and hard limits of a process: its own, else those that it inherits."""
    own = process.limits.rlimits if process.limits else {}
    inherited = {name: resource.getrlimit(number) for name, number in RLIMITS.items()}
    return {**inherited, **{name: (values[0], values[-1]) for name, values in own.items()}}


def _out_of_memory(process: Process, ending: Ending, said: list[str], confines: Confines) -> str | None:
    cap = confines.cap(process.id)
    if cap and cap.killed and process.limits and process.limits.memory:
        return f"the kernel ended it: its memory cap of {process.limits.memory // _MEGABYTE} MiB was used up"
    if kernel_log.tells_of_want_of_memory(said):
        return "the kernel ended it: the memory of the machine was used up"
    killed = ending.hang is None and (ending.signal in _KILLED or ending.code in _KILLED)
    if killed and confines.killed_since_the_begin():
        return (
            "the kernel has ended something for want of memory during this run: the memory of the control group, "
            "of a container perhaps, was used up"
        )
    return None
