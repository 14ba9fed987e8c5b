"""Cores that processes of one plan take from each other, whatever the machine is."""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code

if TYPE_CHECKING:
    from orchestra.errors import Problems
    from orchestra.plan.model import Plan, Process
    from orchestra.resolve.model import Resolved
    from orchestra.values import Limits

_LIMITS: Final = attrgetter("limits")
_REAL_TIME: Final = "fifo"


def check_cores(resolved: Resolved, plan: Plan, problems: Problems) -> None:
    """Report exclusive cores that others are given too, and real-time processes that starve each other."""
    del resolved
    if not any(map(_LIMITS, plan.processes)):
        return
    limited = [(process, process.limits) for process in plan.processes if process.limits is not None]
    owners = {core: process for process, limits in limited if limits.exclusive for core in limits.cores or ()}
    first: dict[tuple[int, int], Process] = {}
    for process, limits in limited:
        _check_exclusive(process, limits, owners, problems)
        _check_real_time(process, limits, first, problems)


def _check_exclusive(
    process: Process, limits: Limits, owners: dict[int, Process], problems: Problems
) -> None:
    taken = [core for core in limits.cores or () if owners.get(core, process) is not process]
    if taken:
        owner = owners[taken[0]]
        message = f"core {taken[0]} of '{process.id}' is exclusive to '{owner.id}'"
        notes = (f"'{owner.id}' is described at {owner.location}",)
        problems.error(Code.CONTESTED_CORE, message, process.location, notes=notes)


def _check_real_time(
    process: Process, limits: Limits, first: dict[tuple[int, int], Process], problems: Problems
) -> None:
    """Report a process that runs only when another one lets it: `fifo` knows no turns within a priority (sched(7))."""
    if limits.scheduler != _REAL_TIME or limits.priority is None or len(limits.cores or ()) != 1:
        return
    (core,) = limits.cores or ()
    other = first.setdefault((core, limits.priority), process)
    if other is not process:
        message = f"'{process.id}' and '{other.id}' share core {core} with the same priority under fifo: neither yields"
        notes = (f"'{other.id}' is described at {other.location}", "the scheduler rr gives them turns")
        problems.warning(Code.CONTESTED_CORE, message, process.location, notes=notes)
