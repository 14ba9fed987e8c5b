"""Memory caps of a plan against the memory of this machine, where nothing is started; a run looks more closely."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code

if TYPE_CHECKING:
    from orchestra.errors import Problems
    from orchestra.plan.model import Plan

_MEGABYTE: Final = 1 << 20


def check_memory(plan: Plan, problems: Problems, machine: int | None = None) -> None:
    """Warn of caps that come to more than `machine` has together, in bytes: what this one has where that is None."""
    capped = [
        (process, process.limits.memory)
        for process in plan.processes
        if process.limits is not None and process.limits.memory is not None
    ]
    if not capped:
        return
    there = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") if machine is None else machine
    total = sum(memory for _, memory in capped)
    if total > there:
        message = (
            f"the memory caps come to {total // _MEGABYTE} MiB together, and this machine has "
            f"{there // _MEGABYTE} MiB: memory can run out before a cap is reached"
        )
        problems.warning(Code.UNFIT_MACHINE, message, capped[-1][0].location)
