"""What this machine has, and what we may do on it: the facts against which the limits of a plan are checked."""

from __future__ import annotations

import os
import resource

from orchestra.dataclass import dataclass
from orchestra.supervise.keeping import proc
from orchestra.supervise.limits.applied import RLIMITS
from orchestra.supervise.limits.cgroups import Place, find_place, own_hierarchy, read, upwards

# From linux/capability.h.
_CAP_SYS_NICE, _CAP_SYS_RESOURCE = 23, 24
# What version 1 of control groups says for no limit is about so much.
_NO_LIMIT = 1 << 62


@dataclass(frozen=True, slots=True)
class Capacity:
    """A machine, as this process may use it.

    `online` are the cores that run, `usable` those that we may use (cpuset(7)). `may_schedule` and `may_raise` say
    whether we have CAP_SYS_NICE and CAP_SYS_RESOURCE (capabilities(7)). `rlimits` are our own soft and hard limits by
    name, `niceness` our own. `memory` is in bytes: that of the machine, or what our control group may use of it.
    `cap_place` is where memory caps can be made, or why nowhere.
    """

    online: frozenset[int]
    usable: frozenset[int]
    may_schedule: bool
    may_raise: bool
    rlimits: dict[str, tuple[int, int]]
    niceness: int
    memory: int
    cap_place: Place | str


def capacity(keeper: int) -> Capacity:
    """Look at this machine; `keeper` is the process below which everything is ours."""
    capabilities = _capabilities()
    usable = _usable()
    return Capacity(
        online=_numbers(read("/sys/devices/system/cpu/online") or "") or usable,
        usable=usable,
        may_schedule=bool(capabilities >> _CAP_SYS_NICE & 1),
        may_raise=bool(capabilities >> _CAP_SYS_RESOURCE & 1),
        rlimits={name: resource.getrlimit(number) for name, number in RLIMITS.items()},
        niceness=os.getpriority(os.PRIO_PROCESS, 0),
        memory=_memory(),
        cap_place=find_place(own_hierarchy(), {keeper, *proc.descendants(keeper)}),
    )


def _usable() -> frozenset[int]:
    """Ask for every core, since the kernel gives those that we may have, and go back to those that we had."""
    before = os.sched_getaffinity(0)
    try:
        os.sched_setaffinity(0, range(os.sysconf("SC_NPROCESSORS_CONF")))
        return frozenset(os.sched_getaffinity(0))
    finally:
        os.sched_setaffinity(0, before)


def _capabilities() -> int:
    for line in (read("/proc/self/status") or "").splitlines():
        name, _, value = line.partition(":")
        if name == "CapEff":
            return int(value, 16)
    return 0


def _memory() -> int:
    total = resource.getpagesize() * os.sysconf("SC_PHYS_PAGES")
    found = own_hierarchy()
    limits = [
        int(text)
        for folder in (upwards(found) if found else ())
        for name in ("memory.max", "memory.limit_in_bytes")
        if (text := (read(f"{folder}/{name}") or "").strip()).isdigit()
    ]
    return min([total, *(limit for limit in limits if limit < _NO_LIMIT)])


def _numbers(text: str) -> frozenset[int]:
    """Read a list of the kernel: `0-3,5` (cpuset(7), "List format")."""
    found: set[int] = set()
    for part in text.strip().split(","):
        first, _, last = part.partition("-")
        if first:
            found.update(range(int(first), int(last or first) + 1))
    return frozenset(found)
