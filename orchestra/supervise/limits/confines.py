"""The limits of a run's processes in action: what has to be there before they start, and what goes with them."""

from __future__ import annotations

import contextlib
import os
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.errors import Severity
from orchestra.logs.names import log_stems
from orchestra.supervise.keeping import proc
from orchestra.supervise.limits import caps
from orchestra.supervise.limits.cgroups import Place, own_hierarchy

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from orchestra.errors import Problem
    from orchestra.plan.model import Plan, Process
    from orchestra.supervise.loop import Loop

# The kernel takes one request in a tenth of a second; in seconds.
_ASK_AGAIN = 0.12


@dataclass(frozen=True, slots=True)
class Cap:
    """What the kernel says of a memory cap: bytes used at most, and how many processes it ended for want of memory."""

    peak: int | None
    killed: int


class Confines:
    """Holds the memory caps of the processes that run; `run` is its id. Without limits in the plan it costs nothing."""

    def __init__(self, loop: Loop, run: str) -> None:
        self._loop = loop
        self._run = run
        self._keeper = caps.keeper_of(run)
        self._place: Place | None = None
        self._groups: dict[str, str] = {}
        self._latest: dict[str, Cap] = {}
        self._own = own_hierarchy()
        self._killed_before = caps.killed(self._own.own) if self._own else 0
        self._pids: dict[str, int] = {}
        self._starts = 0

    def take_up(self, plan: Plan) -> str | None:
        """Make room for the limits of a plan; return why this machine does not allow them, if so."""
        if all(process.limits is None for process in plan.processes):
            return None
        # Here and below: few plans have limits.
        from orchestra.supervise.limits.capacity import capacity  # noqa: PLC0415
        from orchestra.supervise.limits.preflight import exclusive_cores, preflight  # noqa: PLC0415

        machine = capacity(self._keeper)
        errors = [problem for problem in preflight(plan, machine) if problem.severity is Severity.ERROR]
        if errors:
            return "\n".join(map(_line, errors))
        if self._place is None and isinstance(machine.cap_place, Place) and _capped(plan):
            try:
                caps.open_place(machine.cap_place, self._run)
            except OSError as error:
                return f"memory cannot be capped in {machine.cap_place.folder}: {error.strerror}"
            self._place = machine.cap_place
        taken = exclusive_cores(plan)
        if taken:
            _keep_away(taken, (self._keeper, *proc.descendants(self._keeper)))
        return None

    def prepare(self, process: Process) -> Callable[[], None] | None:
        """Return what is to be called in a process before its program begins. Raises `OSError`."""
        limits = process.limits
        if limits is None:
            return None
        from orchestra.supervise.limits.applied import restriction  # noqa: PLC0415

        group = None if limits.memory is None else self._make_group(process, limits.memory)
        return restriction(limits, group, str(process.location))

    def started(self, process: Process, pid: int) -> None:
        """Do what can only be done from outside, now that the process is there."""
        self._pids[process.id] = pid
        if process.limits and process.limits.nice is not None:
            self._settle(process.id, pid, process.limits.nice)

    def cap(self, process: str) -> Cap | None:
        """Return what the kernel says of the memory cap of a process, where it has one or its latest run had."""
        folder = self._groups.get(process)
        return self._latest.get(process) if folder is None else Cap(caps.peak(folder), caps.killed(folder))

    def killed_since_the_begin(self) -> bool:
        """Tell whether the kernel has ended something in our own control group because its memory was used up."""
        return bool(self._own and caps.killed(self._own.own) > self._killed_before)

    def release(self, process: str) -> None:
        """Nothing is left of a process."""
        self._pids.pop(process, None)
        cap, folder = self.cap(process), self._groups.pop(process, None)
        if folder is not None and cap is not None:
            self._latest[process] = cap
            caps.remove(folder)

    def close(self) -> list[str]:
        """Give back everything; return the groups that are still in use, which is a matter for the keeper."""
        return caps.clear(self._keeper) if self._place else []

    def _make_group(self, process: Process, memory: int) -> str | None:
        if self._place is None:
            return None
        self._latest.pop(process.id, None)
        self._starts += 1
        stem = log_stems([process.id])[process.id]
        name = caps.name_of(self._run, f"{stem}.{self._starts}")
        try:
            self._groups[process.id] = caps.make_group(self._place, name, memory)
        except OSError as error:
            text = f"memory cap of {memory} bytes refused: {error.strerror}"
            raise OSError(error.errno, text, str(process.location)) from error
        return self._groups[process.id]

    def _settle(self, process: str, pid: int, nice: int) -> None:
        from orchestra.supervise.limits.applied import settle_session  # noqa: PLC0415

        if self._pids.get(process) == pid and not settle_session(pid, nice):
            self._loop.call_later(_ASK_AGAIN, lambda: self._settle(process, pid, nice))


def checked(plan: Plan, run: str) -> tuple[Problem, ...]:
    """Return what stands against the limits of a plan on this machine, at which we look only where there are some."""
    if all(process.limits is None for process in plan.processes):
        return ()
    from orchestra.supervise.limits.capacity import capacity  # noqa: PLC0415
    from orchestra.supervise.limits.preflight import preflight  # noqa: PLC0415

    return preflight(plan, capacity(caps.keeper_of(run)))


def _capped(plan: Plan) -> bool:
    return any(process.limits and process.limits.memory is not None for process in plan.processes)


def _line(problem: Problem) -> str:
    return "\n    ".join((f"{problem.span}: error: {problem.message}", *problem.notes))


def _keep_away(taken: frozenset[int], pids: Iterable[int]) -> None:
    """Keep processes of our own off cores that belong to others; what they start inherits it."""
    for pid in pids:
        with contextlib.suppress(ProcessLookupError):
            rest = os.sched_getaffinity(pid) - taken
            if rest:
                os.sched_setaffinity(pid, rest)
