"""What of a plan's limits this machine cannot grant, found before anything starts. A pure function of both."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code, Problem, Severity
from orchestra.logs.names import shown
from orchestra.supervise.limits.applied import REAL_TIME, RLIMITS, UNLIMITED, listed
from orchestra.supervise.limits.cgroups import Place

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.plan.model import Plan, Process
    from orchestra.supervise.limits.capacity import Capacity
    from orchestra.values import Limits

# getrlimit(2), RLIMIT_NICE: the least niceness is this less the limit.
_NICE_CEILING = 20
_MEGABYTE = 1 << 20


def preflight(plan: Plan, machine: Capacity) -> tuple[Problem, ...]:
    """Return what stands against the limits of a plan on this machine; each problem stands at its process."""
    limited = [(process, process.limits) for process in plan.processes if process.limits is not None]
    return tuple(
        problem
        for problems in (
            *(_of_process(process, limits, machine) for process, limits in limited),
            _overlaps(limited),
            _nothing_left(plan, limited, machine),
            _too_much_memory(limited, machine),
        )
        for problem in problems
    )


def exclusive_cores(plan: Plan) -> frozenset[int]:
    """Return the cores that belong to one process each."""
    limits = [process.limits for process in plan.processes if process.limits is not None]
    return frozenset(core for one in limits if one.exclusive for core in one.cores or ())


def _of_process(process: Process, limits: Limits, machine: Capacity) -> Iterator[Problem]:
    for complaints in (_cores, _niceness, _priority, _rlimits, _cap):
        for text, *notes in complaints(limits, machine):
            yield _problem(process, f"{shown(process.id)}: {text}", *notes)


def _cores(limits: Limits, machine: Capacity) -> Iterator[tuple[str, ...]]:
    wanted = set(limits.cores or ())
    missing, closed = wanted - machine.online, (wanted & machine.online) - machine.usable
    if missing:
        yield (
            f"there is no core {listed(sorted(missing))}: this machine has {listed(sorted(machine.online))}",
        )
    if closed:
        yield (
            f"core {listed(sorted(closed))} may not be used here, only {listed(sorted(machine.usable))} (cpuset)",
        )
    if limits.exclusive and not wanted:
        yield ("exclusive cores are asked for, but none is named",)


def _niceness(limits: Limits, machine: Capacity) -> Iterator[tuple[str, ...]]:
    if limits.nice is None or limits.nice >= machine.niceness or machine.may_schedule:
        return
    permitted = _soft(limits, machine, "nice")
    least = _NICE_CEILING - permitted
    if permitted != UNLIMITED and limits.nice < least:
        yield (
            f"niceness {limits.nice} is not permitted: the least is {min(least, machine.niceness)}",
            (
                "RLIMIT_NICE has to be higher (`nice` in /etc/security/limits.conf, LimitNICE= of a service), "
                "or CAP_SYS_NICE is needed"
            ),
        )


def _priority(limits: Limits, machine: Capacity) -> Iterator[tuple[str, ...]]:
    if limits.scheduler not in REAL_TIME or machine.may_schedule:
        return
    highest, wanted = _soft(limits, machine, "rtprio"), limits.priority or 1
    if wanted > highest != UNLIMITED:
        permitted = f"the highest is {highest}" if highest else "no real-time scheduling is"
        yield (
            f"scheduler {limits.scheduler} with priority {wanted} is not permitted: {permitted}",
            (
                "RLIMIT_RTPRIO has to be higher (`rtprio` in /etc/security/limits.conf, LimitRTPRIO= of a service), "
                "or CAP_SYS_NICE is needed"
            ),
        )


def _rlimits(limits: Limits, machine: Capacity) -> Iterator[tuple[str, ...]]:
    for name, (soft, hard) in limits.rlimits.items():
        if name not in RLIMITS:
            yield (f"there is no limit {name} on this machine",)
            continue
        if _exceeds(soft, hard):
            yield (f"limit {name}: the soft limit {_words(soft)} is above the hard limit {_words(hard)}",)
        present = machine.rlimits[name][1]
        if _exceeds(hard, present) and not machine.may_raise:
            yield (
                f"limit {name} cannot be raised to {_words(hard)}: the hard limit is {_words(present)}",
                (
                    f"raise it where the session begins (`{name}` in /etc/security/limits.conf, Limit{name.upper()}= "
                    "of a service), or CAP_SYS_RESOURCE is needed"
                ),
            )


def _cap(limits: Limits, machine: Capacity) -> Iterator[tuple[str, ...]]:
    if limits.memory is not None and not isinstance(machine.cap_place, Place):
        yield (
            f"memory cannot be capped: {machine.cap_place}",
            (
                "start it with `systemd-run --user --scope -p Delegate=yes orchestra ...`, give its service "
                "Delegate=yes, or leave the cap out (docs/limits.md)"
            ),
        )


def _overlaps(limited: list[tuple[Process, Limits]]) -> Iterator[Problem]:
    for owner, limits in limited:
        for process, others in limited:
            shared = set(limits.cores or ()) & set(others.cores or ())
            twice = others.exclusive and owner.id > process.id  # told once, by the other one
            if limits.exclusive and process is not owner and shared and not twice:
                yield _problem(
                    process,
                    f"{shown(process.id)}: core {listed(sorted(shared))} is exclusive to {shown(owner.id)}",
                    f"as {owner.location} says",
                )


def _nothing_left(plan: Plan, limited: list[tuple[Process, Limits]], machine: Capacity) -> Iterator[Problem]:
    taken = exclusive_cores(plan)
    others = [process for process in plan.processes if process.limits is None or process.limits.cores is None]
    if taken and others and not machine.usable - taken:
        last = [process for process, limits in limited if limits.exclusive][-1]
        names = f"{shown(others[0].id)}" + (f" and {len(others) - 1} more" if others[1:] else "")
        yield _problem(
            last,
            f"{shown(last.id)}: no core is left for {names}: all of {listed(sorted(machine.usable))} are exclusive",
        )


def _too_much_memory(limited: list[tuple[Process, Limits]], machine: Capacity) -> Iterator[Problem]:
    capped = [(process, limits.memory) for process, limits in limited if limits.memory is not None]
    total = sum(memory for _, memory in capped)
    if total > machine.memory:
        yield _problem(
            capped[-1][0],
            f"the memory caps come to {total // _MEGABYTE} MiB together, and there are "
            f"{machine.memory // _MEGABYTE} MiB: memory can run out before a cap is reached",
            severity=Severity.WARNING,
        )


def _soft(limits: Limits, machine: Capacity, name: str) -> int:
    """Return the soft limit that will be in force when the others are asked for."""
    written = limits.rlimits.get(name)
    return machine.rlimits[name][0] if written is None else written[0]


def _exceeds(value: int, bound: int) -> bool:
    return bound != UNLIMITED and (value == UNLIMITED or value > bound)


def _words(value: int) -> str:
    return "unlimited" if value == UNLIMITED else str(value)


def _problem(process: Process, text: str, *notes: str, severity: Severity = Severity.ERROR) -> Problem:
    where = process.location
    return Problem(
        Code.UNFIT_MACHINE, severity, text, where.span, included_from=where.included_from, notes=notes
    )
