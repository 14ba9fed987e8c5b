"""While nothing happens nothing is done: no process of ours is woken, however much there is to watch."""

from __future__ import annotations

import contextlib
import re
import shutil
import signal
import subprocess
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING

import pytest

from orchestra.plan.conditions import Dependency
from orchestra.values import Restart
from tests.supervise.effort import effort, sleeps
from tests.supervise.plans import HERE, launched, plan, process, ready_when, wait_for

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from orchestra.plan.model import Process
    from tests.supervise.effort import Effort
    from tests.supervise.plans import Launched

_COUNT = 20
_OURS = ("orc-keeper", "orc-supervisor", "orc-guard")
_QUIET = 0.6
_SHARE = 0.001  # of one core, all together


def idlers() -> list[Process]:
    """Return processes of every sort, which say that they are there and then wait for ever."""
    sorts: tuple[dict[str, object], ...] = (
        {},
        {"emulate_tty": True},
        {"restart": Restart("always")},
        {"ready": ready_when(log="up", timeout=60.0)},
        {"depends_on": (Dependency("p3", "ready", 4.0, HERE, required=False),)},
    )
    return [process(f"p{n}", "say=up", "partial=?", "linger", **sorts[n % len(sorts)]) for n in range(_COUNT)]


@contextmanager
def at_rest(folder: Path) -> Iterator[Launched]:
    """Run the idle processes, and wait until all that their start gave occasion for is over."""
    # A folder of its own for its socket: others on this machine look at every run that they can find.
    with launched(folder, plan(*idlers()), environment={"XDG_RUNTIME_DIR": str(folder)}) as run:
        for number in range(_COUNT):
            run.await_line(f"p{number}", "up")
        seen: list[list[Effort]] = [efforts(run)]

        def quiet() -> bool:
            time.sleep(_QUIET)
            seen.append(efforts(run))
            return seen[-1] == seen[-2] and all(sleeps(run.own(name)) for name in _OURS)

        wait_for(quiet, f"rest, and not {seen}")
        yield run
        run.send(signal.SIGINT)
        assert run.wait() == 130
        run.assert_gone()


def efforts(run: Launched) -> list[Effort]:
    """Return what our processes have done so far."""
    return [effort(run.own(name)) for name in _OURS]


def watched(run: Launched, seconds: float) -> tuple[int, float]:
    """Return how often they were woken in a time, and their share of a core."""
    before = efforts(run)
    time.sleep(seconds)
    after_it = efforts(run)
    pairs = list(zip(before, after_it, strict=True))
    waits = sum(late.waits - early.waits for early, late in pairs)
    return waits, sum(late.seconds - early.seconds for early, late in pairs) / seconds


def test_nobody_is_woken(tmp_path: Path) -> None:
    with at_rest(tmp_path) as run:
        assert watched(run, 3.0) == (0, 0.0)


@pytest.mark.long
@pytest.mark.timeout(300)
def test_nobody_is_woken_for_a_minute(tmp_path: Path) -> None:
    with at_rest(tmp_path) as run:
        waits, share = watched(run, 60.0)
        assert waits == 0
        assert share < _SHARE


@pytest.mark.long
@pytest.mark.timeout(300)
@pytest.mark.skipif(shutil.which("strace") is None, reason="counts system calls with strace(1)")
def test_no_system_call_in_a_minute(tmp_path: Path) -> None:
    with at_rest(tmp_path) as run:
        out = tmp_path / "calls"
        words = [word for name in _OURS for word in ("-p", str(run.own(name)))]
        with subprocess.Popen(["strace", "-f", "-o", str(out), *words], stderr=subprocess.PIPE) as tracer:
            time.sleep(60.0)
            tracer.send_signal(signal.SIGINT)
            with contextlib.suppress(subprocess.TimeoutExpired):
                tracer.communicate(timeout=20.0)
        calls = re.findall(r"(?m)^(\d+) +(?!restart_syscall)(\w+)\(", out.read_text())
        # Attaching interrupts the call in which each thread waits, and each makes it once more (ptrace(2)).
        threads = {thread for thread, _ in calls}
        assert len(calls) <= 2 * len(threads), calls
