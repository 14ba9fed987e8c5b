"""Limits that a machine cannot grant: found before anything starts, all of them, each at its place."""

from __future__ import annotations

import ctypes
import os
import resource
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.errors import Severity
from orchestra.location import Location, point
from orchestra.supervise.limits.capacity import Capacity, capacity
from orchestra.supervise.limits.cgroups import Hierarchy, Place, find_place, hierarchy
from orchestra.supervise.limits.preflight import preflight
from orchestra.values import Limits
from tests.supervise.plans import finished, plan, process

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Process

_CAPS = Place(Hierarchy(2, "/sys/fs/cgroup", "/sys/fs/cgroup/ours"), "/sys/fs/cgroup/ours")
_GIGABYTE = 1 << 30
MACHINE = Capacity(
    online=frozenset(range(4)),
    usable=frozenset({0, 1, 2}),
    may_schedule=False,
    may_raise=False,
    rlimits={"nofile": (1024, 4096), "nice": (0, 0), "rtprio": (0, 0), "memlock": (65536, 65536)},
    niceness=0,
    memory=4 * _GIGABYTE,
    cap_place=_CAPS,
)
PRIVILEGED = replace(MACHINE, may_schedule=True, may_raise=True)


def limited(identity: str, /, line: int = 1, **limits: Any) -> Process:
    """Return a process with limits, written in a line of `limits.yaml`."""
    return process(identity, "exit=0", limits=Limits(**limits), location=Location(point("limits.yaml", line)))


def told(*processes: Process, machine: Capacity = MACHINE) -> list[str]:
    """Return what is wrong with a plan, each problem with its line."""
    problems = preflight(plan(*processes), machine)
    return [f"{problem.span.line if problem.span else ''}: {problem.message}" for problem in problems]


FITTING: list[tuple[dict[str, Any], Capacity]] = [
    ({}, MACHINE),
    ({"cores": (0, 2)}, MACHINE),
    ({"cores": (1,), "exclusive": True}, MACHINE),
    ({"nice": 0}, MACHINE),
    ({"nice": 19}, MACHINE),
    ({"nice": -20}, PRIVILEGED),
    ({"nice": -5}, replace(MACHINE, rlimits={**MACHINE.rlimits, "nice": (25, 25)})),
    ({"nice": -5}, replace(MACHINE, rlimits={**MACHINE.rlimits, "nice": (-1, -1)})),
    ({"nice": 5}, replace(MACHINE, niceness=5)),
    ({"scheduler": "fifo", "priority": 99}, PRIVILEGED),
    ({"scheduler": "rr", "priority": 10}, replace(MACHINE, rlimits={**MACHINE.rlimits, "rtprio": (10, 10)})),
    ({"scheduler": "rr", "priority": 99}, replace(MACHINE, rlimits={**MACHINE.rlimits, "rtprio": (-1, -1)})),
    ({"scheduler": "idle"}, MACHINE),
    ({"rlimits": {"nofile": (4096, 4096)}}, MACHINE),
    ({"rlimits": {"nofile": (9999, 9999)}}, PRIVILEGED),
    ({"memory": _GIGABYTE}, MACHINE),
]


@pytest.mark.parametrize(("limits", "machine"), FITTING)
def test_what_fits_is_let_pass(limits: dict[str, Any], machine: Capacity) -> None:
    assert told(limited("a", **limits), process("b", "exit=0"), machine=machine) == []


UNFIT: list[tuple[dict[str, Any], str]] = [
    ({"cores": (0, 7, 9)}, "there is no core 7, 9: this machine has 0, 1, 2, 3"),
    ({"cores": (3,)}, "core 3 may not be used here, only 0, 1, 2 (cpuset)"),
    ({"exclusive": True}, "exclusive cores are asked for, but none is named"),
    ({"nice": -1}, "niceness -1 is not permitted: the least is 0"),
    (
        {"scheduler": "fifo", "priority": 5},
        "scheduler fifo with priority 5 is not permitted: no real-time scheduling is",
    ),
    (
        {"scheduler": "rr", "priority": 5, "rlimits": {"rtprio": (0, 0)}},
        "scheduler rr with priority 5 is not permitted: no real-time scheduling is",
    ),
    (
        {"rlimits": {"nofile": (1024, 8192)}},
        "limit nofile cannot be raised to 8192: the hard limit is 4096",
    ),
    (
        {"rlimits": {"memlock": (-1, -1)}},
        "limit memlock cannot be raised to unlimited: the hard limit is 65536",
    ),
    ({"rlimits": {"nofile": (20, 10)}}, "limit nofile: the soft limit 20 is above the hard limit 10"),
    ({"rlimits": {"patience": (1, 1)}}, "there is no limit patience on this machine"),
]


@pytest.mark.parametrize(("limits", "text"), UNFIT)
def test_what_does_not_fit_is_named_at_its_place(limits: dict[str, Any], text: str) -> None:
    assert told(limited("/robot/a", 7, **limits)) == [f"7: robot/a: {text}"]


def test_a_process_that_raises_its_own_permission_is_let_pass() -> None:
    machine = replace(MACHINE, rlimits={**MACHINE.rlimits, "rtprio": (0, 50)})
    raised = limited("a", scheduler="fifo", priority=50, rlimits={"rtprio": (50, 50)})
    assert told(raised, machine=machine) == []
    assert told(limited("a", scheduler="fifo", priority=50), machine=machine)


def test_an_exclusive_core_is_not_shared() -> None:
    owner, other = limited("a", 3, cores=(0, 1), exclusive=True), limited("b", 8, cores=(1, 2))
    assert told(owner, other) == ["8: b: core 1 is exclusive to a"]
    assert told(other, owner) == ["8: b: core 1 is exclusive to a"]


def test_two_that_want_a_core_for_themselves_are_told_once() -> None:
    first, second = (limited(name, 3, cores=(1,), exclusive=True) for name in "ab")
    assert told(first, second) == ["3: b: core 1 is exclusive to a"]


def test_somebody_has_to_have_a_core() -> None:
    cores = [limited(str(core), 3 + core, cores=(core,), exclusive=True) for core in range(3)]
    assert told(*cores) == []
    assert told(*cores, process("b", "exit=0"), process("c", "exit=0")) == [
        "5: 2: no core is left for b and 1 more: all of 0, 1, 2 are exclusive"
    ]


def test_caps_beyond_the_memory_there_is_are_a_warning() -> None:
    caps = [limited(name, memory=3 * _GIGABYTE) for name in "ab"]
    (problem,) = preflight(plan(*caps), MACHINE)
    assert problem.severity is Severity.WARNING
    assert problem.message.startswith("the memory caps come to 6144 MiB together, and there are 4096 MiB")


def test_a_cap_without_a_group_says_what_to_do() -> None:
    machine = replace(MACHINE, cap_place="no control group can be made here")
    (problem,) = preflight(plan(limited("a", 2, memory=_GIGABYTE)), machine)
    assert problem.message == "a: memory cannot be capped: no control group can be made here"
    assert "systemd-run --user --scope -p Delegate=yes" in problem.notes[0]


# Runs.


def test_a_run_that_cannot_be_is_refused_before_anything_starts(tmp_path: Path) -> None:
    wrong = limited("b", 9, cores=(4095,))
    run = finished(tmp_path, plan(process("a", "say=up", "exit=0"), wrong, limited("c", 12, cores=(4094,))))
    assert run.wait() == 2
    assert "limits.yaml:9:1: error: b: there is no core 4095" in run.stderr
    assert "limits.yaml:12:1: error: c: there is no core 4094" in run.stderr
    assert not (tmp_path / "home" / "runs").exists()


def _without_privileges() -> None:
    """Give up the capabilities that matter, and the permissions that stand for them (prctl(2), PR_CAPBSET_DROP)."""
    libc = ctypes.CDLL(None)
    for capability in (23, 24):
        libc.prctl(24, capability, 0, 0, 0)
    for name in ("NICE", "RTPRIO"):
        resource.setrlimit(getattr(resource, f"RLIMIT_{name}"), (0, 0))


@pytest.mark.parametrize(
    ("limits", "text"),
    [
        ({"scheduler": "fifo", "priority": 5}, "no real-time scheduling is"),
        ({"nice": -20}, "niceness -20 is not permitted"),
        ({"rlimits": {"nofile": (-1, -1)}}, "limit nofile cannot be raised to unlimited"),
    ],
)
def test_missing_permission_is_found_before_anything_starts(
    tmp_path: Path, limits: dict[str, Any], text: str
) -> None:
    """For root in a container and for everybody else."""
    run = finished(tmp_path, plan(limited("a", 4, **limits)), preexec_fn=_without_privileges)
    assert run.wait() == 2
    assert "limits.yaml:4:1: error: a: " in run.stderr
    assert text in run.stderr


# What the machine says of itself.


def test_this_machine_is_known() -> None:
    machine = capacity(os.getpid())
    assert machine.usable <= machine.online
    assert set(os.sched_getaffinity(0)) <= machine.usable
    assert machine.rlimits["nofile"] == resource.getrlimit(resource.RLIMIT_NOFILE)
    assert 0 < machine.memory <= os.sysconf("SC_PHYS_PAGES") * resource.getpagesize()


def test_looking_at_the_cores_leaves_them_as_they_were() -> None:
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(before)})
    try:
        assert before <= capacity(os.getpid()).usable
        assert os.sched_getaffinity(0) == {min(before)}
    finally:
        os.sched_setaffinity(0, before)


MOUNTS_1 = (
    "31 23 0:28 / /sys/fs/cgroup rw,relatime - tmpfs tmpfs rw,mode=755\n"
    "35 31 0:32 / /sys/fs/cgroup/memory rw,relatime shared:7 - cgroup cgroup rw,memory\n"
    "41 31 0:38 / /sys/fs/cgroup/unified rw,relatime - cgroup2 cgroup2 rw\n"
)
MOUNTS_2 = "30 23 0:26 / /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n"
HIERARCHIES = [
    ("4:memory:/a/b\n0::/\n", MOUNTS_1, Hierarchy(1, "/sys/fs/cgroup/memory", "/sys/fs/cgroup/memory/a/b")),
    ("0::/user.slice/x.scope\n", MOUNTS_2, Hierarchy(2, "/sys/fs/cgroup", "/sys/fs/cgroup/user.slice/x.scope")),
    ("0::/\n", MOUNTS_2, Hierarchy(2, "/sys/fs/cgroup", "/sys/fs/cgroup")),
    ("3:cpu,memory:/\n", MOUNTS_1.replace("rw,memory", "rw,cpu,memory"), Hierarchy(1, *["/sys/fs/cgroup/memory"] * 2)),
    (  # a container of the older kind sees the groups of its host, and of the mount only its own part
        "4:memory:/docker/abc/x\n",
        MOUNTS_1.replace("0:32 / /sys", "0:32 /docker/abc /sys"),
        Hierarchy(1, "/sys/fs/cgroup/memory", "/sys/fs/cgroup/memory/x"),
    ),
    ("0::/\n", "30 23 0:26 / / rw - ext4 /dev/vda rw\n", None),
]  # fmt: skip


@pytest.mark.parametrize(("groups", "mounts", "found"), HIERARCHIES)
def test_the_hierarchy_for_memory(groups: str, mounts: str, found: Hierarchy | None) -> None:
    assert hierarchy(groups, mounts) == found


def test_no_hierarchy_and_a_group_of_somebody_else_are_told(tmp_path: Path) -> None:
    assert "no hierarchy" in str(find_place(None, ()))
    missing = str(tmp_path / "missing")
    assert "belongs to somebody else" in str(find_place(Hierarchy(1, str(tmp_path), missing), ()))
    assert "the memory controller is not there" in str(find_place(Hierarchy(2, str(tmp_path), missing), ()))
