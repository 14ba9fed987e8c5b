"""Limits in a run: a program never runs without them, and what refuses them is told."""

from __future__ import annotations

import os
import resource
import signal
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.limits import caps, cgroups
from orchestra.supervise.limits.capacity import capacity
from orchestra.supervise.limits.cgroups import Place
from tests.supervise.plans import finished, launched, plan, process, wait_for

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.plan.model import Process
    from tests.supervise.plans import Launched

from orchestra.values import Limits, Restart

_USABLE = sorted(capacity(os.getpid()).usable)
# Not every user may be nicer than what the tests are run with.
_NICE = max(7, os.getpriority(os.PRIO_PROCESS, 0))
_FREE = sorted(os.sched_getaffinity(0))
needs_two_cores = pytest.mark.skipif(len(_FREE) < 2, reason="there is one core")
_PLACE = capacity(os.getppid()).cap_place
needs_caps = pytest.mark.skipif(not isinstance(_PLACE, Place), reason=str(_PLACE))


def _real_time_is_refused() -> str:
    """Return why there is no real time here: whoever may ask for it gets none in a group that has no share of it."""
    if not capacity(os.getpid()).may_schedule:
        return "CAP_SYS_NICE is missing"
    before = os.sched_getscheduler(0), os.sched_getparam(0)
    try:
        os.sched_setscheduler(0, os.SCHED_RR, os.sched_param(1))
    except PermissionError as error:
        return f"the kernel refuses real time: {error}"
    os.sched_setscheduler(0, *before)
    return ""


_REFUSED = _real_time_is_refused()
needs_real_time = pytest.mark.skipif(bool(_REFUSED), reason=_REFUSED)


def program(identity: str, code: str, limits: Limits | None = None, **changes: object) -> Process:
    """Return a process that runs Python code."""
    return process(identity, command=(sys.executable, "-S", "-E", "-c", code), limits=limits, **changes)


@needs_two_cores
def test_a_process_runs_on_its_cores_alone(tmp_path: Path) -> None:
    shows = "import os; print(sorted(os.sched_getaffinity(0)))"
    run = finished(tmp_path, plan(program("a", shows, Limits(cores=(_FREE[1],))), program("b", shows)))
    assert (run.log("a"), run.log("b")) == (f"[{_FREE[1]}]\n", f"{_FREE}\n")


@needs_two_cores
def test_nobody_else_runs_on_an_exclusive_core(tmp_path: Path) -> None:
    """Neither another process of the plan, nor what it starts, nor Orchestra itself."""
    mine, others = _FREE[0], _FREE[1:]
    lingers = "import os, signal; print(sorted(os.sched_getaffinity(0)), flush=True); signal.pause()"
    first = program("a", lingers, Limits(cores=(mine,), exclusive=True))
    with launched(tmp_path, plan(first, program("b", lingers))) as run:
        run.await_line("a", f"[{mine}]")
        run.await_line("b", f"{others}")
        for own in ("orc-keeper", "orc-supervisor"):
            assert sorted(os.sched_getaffinity(run.own(own))) == others


def test_niceness_counts_within_the_session_and_among_sessions(tmp_path: Path) -> None:
    """The kernel groups by session where it has autogroups, and then niceness alone would change nothing."""
    shows = "import os, signal; print(os.getpriority(os.PRIO_PROCESS, 0), flush=True); signal.pause()"
    with launched(tmp_path, plan(program("a", shows, Limits(nice=_NICE)))) as run:
        run.await_line("a", str(_NICE))
        group = Path(f"/proc/{run.await_event('process_running', 'a').pid}/autogroup")
        if group.exists():
            wait_for(lambda: group.read_text().endswith(f" nice {_NICE}\n"), "the niceness of the session")


@pytest.mark.parametrize("scheduler", ["batch", "idle"])
def test_a_scheduler_without_priority(tmp_path: Path, scheduler: str) -> None:
    shows = "import os; print(os.sched_getscheduler(0))"
    run = finished(tmp_path, plan(program("a", shows, Limits(scheduler=scheduler))))  # type: ignore[arg-type]
    assert run.log("a") == f"{getattr(os, f'SCHED_{scheduler.upper()}')}\n"


@needs_real_time
@pytest.mark.parametrize("scheduler", ["fifo", "rr"])
def test_real_time_goes_on_to_threads_and_children(tmp_path: Path, scheduler: str) -> None:
    shows = (
        "import os, threading\n"
        "def show(): print(os.sched_getscheduler(0), os.sched_getparam(0).sched_priority, flush=True)\n"
        "show()\n"
        "thread = threading.Thread(target=show)\n"
        "thread.start()\n"
        "thread.join()\n"
        "if os.fork() == 0:\n"
        "    show()\n"
        "    os._exit(0)\n"
        "os.wait()\n"
    )
    limits = Limits(scheduler=scheduler, priority=11)  # type: ignore[arg-type]
    run = finished(tmp_path, plan(program("a", shows, limits)))
    assert run.log("a") == f"{getattr(os, f'SCHED_{scheduler.upper()}')} 11\n" * 3


def test_limits_of_resources(tmp_path: Path) -> None:
    shows = (
        "import resource\n"
        "for name in ('NOFILE', 'CORE', 'MEMLOCK'):\n"
        "    print(resource.getrlimit(getattr(resource, f'RLIMIT_{name}')))\n"
    )
    wanted: dict[str, tuple[int, ...]] = {"nofile": (64, 128), "core": (0, 0), "memlock": (4096, 8192)}
    run = finished(tmp_path, plan(program("a", shows, Limits(rlimits=wanted))))
    assert run.log("a") == "(64, 128)\n(0, 0)\n(4096, 8192)\n"


def test_what_others_inherit_is_not_touched(tmp_path: Path) -> None:
    limited = program("a", "pass", Limits(nice=_NICE, rlimits={"nofile": (64, 64)}))
    shows = (
        "import os, resource\n"
        "print(os.getpriority(os.PRIO_PROCESS, 0), resource.getrlimit(resource.RLIMIT_NOFILE)[1])\n"
    )
    run = finished(tmp_path, plan(limited, program("b", shows)))
    assert (
        run.log("b")
        == f"{os.getpriority(os.PRIO_PROCESS, 0)} {resource.getrlimit(resource.RLIMIT_NOFILE)[1]}\n"
    )


def test_limits_hold_again_after_a_restart(tmp_path: Path) -> None:
    shows = "import os, sys; print(os.getpriority(os.PRIO_PROCESS, 0), flush=True); sys.exit(1)"
    again = program("a", shows, Limits(nice=_NICE), restart=Restart("on-failure", budget=1))
    run = finished(tmp_path, plan(again))
    assert run.log("a") == f"{_NICE}\n{_NICE}\n"


def test_what_the_kernel_refuses_is_a_failure_to_start_with_its_place(tmp_path: Path) -> None:
    """The check before the start does not know everything that a kernel may refuse."""
    run = finished(tmp_path, plan(program("a", "print('never')", Limits(scheduler="batch", priority=5))))
    refused = "scheduler batch with priority 5 refused: invalid argument: by_hand.yaml:1:1"
    assert f"a could not be started: {refused}\n" in run.stderr
    assert run.of_kind("process_failed", "a")[0].data["code"] == 126
    assert not (run.directory / "logs" / "a.log").exists()


def test_limits_that_leave_no_room_for_a_program_end_it(tmp_path: Path) -> None:
    run = finished(tmp_path, plan(program("a", "print('never')", Limits(rlimits={"as": (1 << 20, 1 << 20)}))))
    assert run.of_kind("process_failed", "a")
    assert "never" not in run.stdout


# Memory caps.

_MEGABYTE = 1 << 20
_HOG = "kept = []\nwhile True:\n    kept.append(b'x' * (1 << 20))\n"


def groups_of(run: Launched) -> list[Path]:
    """Return the control groups of a run."""
    assert isinstance(_PLACE, Place)
    return list(Path(_PLACE.folder).glob(f"orchestra-*-{run.popen.pid}.*"))


@needs_caps
def test_who_uses_more_memory_than_its_cap_is_ended(tmp_path: Path) -> None:
    run = finished(tmp_path, plan(program("a", _HOG, Limits(memory=40 * _MEGABYTE))))
    assert "a failed (SIGKILL" in run.stderr
    assert not groups_of(run)


@needs_caps
def test_a_cap_counts_all_that_a_process_starts(tmp_path: Path) -> None:
    """The child is a daemon in a session of its own, and the cap holds it all the same."""
    code = (
        "import os, sys\n"
        "if os.fork() == 0:\n"
        "    os.setsid()\n"
        "    if os.fork() == 0:\n"
        "        kept = []\n"
        "        while True: kept.append(b'x' * (1 << 20))\n"
        "    os._exit(0)\n"
        "os.wait()\n"
        "print(open('/proc/self/cgroup').read(), flush=True)\n"
        "import signal; signal.pause()\n"
    )
    with launched(tmp_path, plan(program("a", code, Limits(memory=40 * _MEGABYTE)))) as run:
        run.await_event("process_running", "a")
        group = wait_for(lambda: groups_of(run), "the control group")[0]
        wait_for(
            lambda: not group.exists() or caps.killed(str(group)), "the end of the one that takes too much"
        )
        run.send(signal.SIGINT)
        run.wait()
        assert not groups_of(run)


@needs_caps
def test_a_cap_that_is_kept_harms_nobody_and_leaves_nothing(tmp_path: Path) -> None:
    modest = program("a", "print(len(b'x' * (10 << 20)))", Limits(memory=200 * _MEGABYTE))
    run = finished(tmp_path, plan(modest))
    assert run.wait() == 0
    assert run.log("a") == f"{10 << 20}\n"
    assert not groups_of(run)


@needs_caps
@pytest.mark.parametrize("victim", ["orc-supervisor", "orc-keeper"])
def test_whoever_is_killed_no_group_is_left(tmp_path: Path, victim: str) -> None:
    lingers = "import signal; print('up', flush=True); signal.pause()"
    with launched(tmp_path, plan(program("a", lingers, Limits(memory=200 * _MEGABYTE)))) as run:
        run.await_line("a", "up")
        assert groups_of(run)
        os.kill(run.own(victim), signal.SIGKILL)
        run.assert_gone()
        wait_for(lambda: not groups_of(run), "the end of the control groups", 6.0)


@needs_caps
def test_what_is_left_where_keeper_and_supervisor_are_killed_at_once_is_cleaned(tmp_path: Path) -> None:
    lingers = "import signal; print('up', flush=True); signal.pause()"
    with launched(tmp_path, plan(program("a", lingers, Limits(memory=200 * _MEGABYTE)))) as run:
        run.await_line("a", "up")
        supervisor, keeper = run.own("orc-supervisor"), run.popen.pid
        for pid in (keeper, supervisor):
            os.kill(pid, signal.SIGSTOP)
        for pid in (keeper, supervisor):
            os.kill(pid, signal.SIGKILL)
        run.popen.wait()
        assert groups_of(run)
        cleaning = [sys.executable, "-m", "orchestra", "clean", "--yes"]
        cleaned = subprocess.run(
            cleaning, env={**os.environ, "ORCHESTRA_HOME": str(run.home)}, capture_output=True, check=False
        )
        assert cleaned.returncode == 0, cleaned.stderr
        assert not groups_of(run)


@pytest.fixture
def own_group(tmp_path: Path) -> Iterator[tuple[Path, tuple[str, ...]]]:
    """A group of version 2 that nobody is in, and the words before a command that is to be in it alone."""
    found = cgroups.own_hierarchy()
    if found is None or found.version == 1:
        pytest.skip("version 2 of control groups has no memory here")
    given = cgroups.read(f"{found.root}/cgroup.subtree_control") or ""
    if "memory" not in given.split() or not os.access(found.root, os.W_OK):
        pytest.skip("no group with memory can be made")
    group = Path(found.root) / f"test-{tmp_path.name}-{os.getpid()}"
    group.mkdir()
    yield group, ("/bin/sh", "-c", f'echo $$ > {group}/cgroup.procs && exec "$@"', "sh")
    for inner in sorted(group.glob("**/"), reverse=True):
        inner.rmdir()


def test_a_group_with_nobody_but_us_is_enough(
    tmp_path: Path, own_group: tuple[Path, tuple[str, ...]]
) -> None:
    """Everybody moves out of it for the time of the run, and back."""
    group, through = own_group
    lingers = "print(open('/proc/self/cgroup').read(), flush=True); import signal; signal.pause()"
    capped, free = program("a", lingers, Limits(memory=200 * _MEGABYTE)), program("b", lingers)
    with launched(tmp_path, plan(capped, free), through=through) as run:
        run.await_line("a", "")
        run.await_line("b", "")
        assert ".a.1\n" in run.log("a")
        assert ".supervisor\n" in run.log("b")
        assert not cgroups.members(str(group))
        run.send(signal.SIGINT)
        run.wait()
    assert [path for path in group.iterdir() if path.is_dir()] == []
    assert not (cgroups.read(f"{group}/cgroup.subtree_control") or "").split()


def test_a_group_of_a_service_that_gives_us_one_below_it(
    tmp_path: Path, own_group: tuple[Path, tuple[str, ...]]
) -> None:
    """As systemd does for `DelegateSubgroup=`: the caps stand beside our own group, and nobody has to move."""
    group, _ = own_group
    ours = group / "main"
    ours.mkdir()
    cgroups.write(f"{group}/cgroup.subtree_control", "+memory")
    os.setxattr(group, "user.delegate", b"1")
    through = ("/bin/sh", "-c", f'echo $$ > {ours}/cgroup.procs && exec "$@"', "sh")
    lingers = "import signal; print('up', flush=True); signal.pause()"
    capped = program("a", lingers, Limits(memory=200 * _MEGABYTE))
    with launched(tmp_path, plan(capped), through=through) as run:
        run.await_line("a", "up")
        assert len(list(group.glob("orchestra-*.a.1"))) == 1
        assert run.own("orc-supervisor") in cgroups.members(str(ours))
        os.kill(run.own("orc-supervisor"), signal.SIGKILL)
        run.assert_gone()
        wait_for(lambda: not list(group.glob("orchestra-*")), "the end of the control groups", 6.0)


def test_a_run_without_limits_makes_no_group(tmp_path: Path) -> None:
    with launched(tmp_path, plan(process("a", "say=up", "linger"))) as run:
        run.await_line("a", "up")
        pid = run.await_event("process_running", "a").pid
        assert pid is not None
        assert cgroups.read(f"/proc/{pid}/cgroup") == cgroups.read("/proc/self/cgroup")
