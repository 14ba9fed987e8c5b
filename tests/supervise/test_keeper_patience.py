"""How long the keeper waits for its supervisor, and how long the supervisor takes without its keeper."""

from __future__ import annotations

import os
import signal
import time
from types import SimpleNamespace
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.keeping import keeper, proc
from orchestra.supervise.keeping import patience as patiences
from orchestra.supervise.keeping.patience import USUAL, Effort, Patience
from orchestra.values import Stop
from tests.supervise.plans import launched, plan, process

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


class Clock:
    """The keeper's clock; what the supervisor has had of a processor goes with it at a rate."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, rate: float | None) -> None:
        self.now = 100.0
        self._rate = rate
        for module in (keeper, patiences):
            monkeypatch.setattr(module, "time", SimpleNamespace(monotonic=lambda: self.now))
        monkeypatch.setattr(proc, "run_time", self._run_time)

    def wait(self, seconds: float | None) -> None:
        """Let time pass without a signal."""
        assert seconds is not None
        self.now += seconds

    def _run_time(self, _pid: int) -> float | None:
        return None if self._rate is None else self.now * self._rate


@pytest.mark.parametrize(
    ("rate", "most"),
    [
        pytest.param(0.0, 0.0, id="asleep"),
        pytest.param(1.0, 0.0, id="in a loop"),
        pytest.param(0.1, 20.0, id="in a loop, with a tenth of a processor"),
        pytest.param(0.001, 30.0, id="with next to none"),
        pytest.param(None, 0.0, id="on a kernel that does not tell"),
    ],
)
def test_who_has_no_processor_is_not_stuck(
    monkeypatch: pytest.MonkeyPatch, rate: float | None, most: float
) -> None:
    clock = Clock(monkeypatch, rate)
    effort = Effort(1)
    starved = 0.0
    for second in range(1, 40):
        clock.now += 1.0
        effort.look()
        if second >= USUAL and effort.starved:
            starved = second
    assert starved == pytest.approx(most, abs=1.0)


def test_time_in_which_the_keeper_stood_still_does_not_count(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = Clock(monkeypatch, 0.0)
    waits: list[float] = []

    def fetch(seconds: float | None) -> None:
        clock.wait(seconds)
        clock.now += 0.0 if waits else 600.0
        waits.append(seconds or 0.0)

    monkeypatch.setattr(keeper, "_fetch", fetch)
    monkeypatch.setattr(os, "kill", lambda *_: None)
    watch = keeper._Watch(1, None, Patience(), None, None)  # type: ignore[arg-type]
    watch._stop(signal.SIGINT)
    assert watch._next() is None
    assert sum(waits) == pytest.approx(USUAL)


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


@pytest.mark.parametrize(("presses", "waited"), [(1, 603.0), (2, 603.0), (3, USUAL)])
def test_the_third_ctrl_c_takes_the_time_back(
    monkeypatch: pytest.MonkeyPatch, presses: int, waited: float
) -> None:
    """A supervisor that has asked for ten minutes and is stuck is not waited for so long."""
    clock = Clock(monkeypatch, 0.0)
    sent: list[int] = []
    monkeypatch.setattr(os, "kill", lambda _pid, number: sent.append(number))
    monkeypatch.setattr(keeper, "_fetch", clock.wait)
    patience = Patience()
    patience.grant(600.0)
    stacks = SimpleNamespace(read=lambda _patience: "")
    watch = keeper._Watch(os.getpid(), None, patience, stacks, None)  # type: ignore[arg-type]
    for _ in range(presses):
        watch._stop(signal.SIGINT)
    while signal.SIGKILL not in sent:
        assert watch._next() is None
        watch._lose_patience()
    assert clock.now - 100.0 == pytest.approx(waited, abs=1.0)


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
