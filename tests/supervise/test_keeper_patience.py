"""How long the keeper waits for its supervisor, and how long the supervisor takes without its keeper."""

from __future__ import annotations

import os
import signal
import time
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.keeping.patience import USUAL, Patience
from orchestra.values import Stop
from tests.supervise.plans import launched, plan, process, wait_for

if TYPE_CHECKING:
    from pathlib import Path

STUBBORN = ("ignore=INT,TERM", "say=up", "linger")


def test_what_a_child_asks_for_its_parent_sees() -> None:
    patience = Patience()
    assert patience.remaining() < 0
    child = os.fork()
    if child == 0:
        patience.grant(100.0)
        os._exit(0)
    os.waitpid(child, 0)
    assert 100.0 < patience.remaining() < 110.0


def test_nothing_is_granted_before_somebody_asks() -> None:
    Patience().grant(100.0)
    assert Patience().remaining() < 0


@pytest.mark.long
def test_a_run_may_take_longer_where_its_description_says_so(tmp_path: Path) -> None:
    patient = Stop(timeout=USUAL + 1.0, kill_timeout=0.3)
    with launched(tmp_path, plan(process("a", *STUBBORN, stop=patient))) as run:
        run.await_line("a", "up")
        begin = time.monotonic()
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert time.monotonic() - begin > USUAL + 1.0
        assert "does not answer" not in run.stderr


@pytest.mark.long
def test_the_third_ctrl_c_takes_the_time_back(tmp_path: Path) -> None:
    """A supervisor that has asked for ten minutes and is stuck is not waited for so long."""
    patient = Stop(timeout=600.0, kill_timeout=0.3)
    with launched(tmp_path, plan(process("a", *STUBBORN, stop=patient))) as run:
        run.await_line("a", "up")
        run.send(signal.SIGINT)
        run.await_event("signal_sent", "a")
        supervisor = run.own("orc-supervisor")
        begin = time.monotonic()
        for _ in range(2):
            run.send(signal.SIGINT)
            wait_for(lambda: not pending(run.popen.pid, signal.SIGINT), "the keeper to hear it")
            os.kill(supervisor, signal.SIGSTOP)
        assert run.wait() in (1, 130)
        assert time.monotonic() - begin < 2 * USUAL
        run.assert_gone()


def pending(pid: int, number: int) -> bool:
    """Tell whether a signal has not been fetched yet (proc(5), ShdPnd)."""
    with open(f"/proc/{pid}/status") as status:  # noqa: PTH123
        mask = next(line.split()[1] for line in status if line.startswith("ShdPnd:"))
    return bool(int(mask, 16) >> (number - 1) & 1)


@pytest.mark.parametrize(
    "stopping",
    [
        pytest.param(False, marks=pytest.mark.long, id="while it runs"),
        pytest.param(True, id="while it stops"),
    ],
)
def test_without_a_keeper_nobody_gets_more_time_than_usual(tmp_path: Path, *, stopping: bool) -> None:
    patient = Stop(timeout=60.0, kill_timeout=60.0)
    with launched(tmp_path, plan(process("a", *STUBBORN, stop=patient))) as run:
        run.await_line("a", "up")
        if stopping:
            run.send(signal.SIGINT)
            run.await_event("signal_sent", "a")
        run.send(signal.SIGKILL)
        run.assert_gone(9.0)
