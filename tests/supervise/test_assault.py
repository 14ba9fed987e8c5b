"""Whichever single process of Orchestra is signalled or killed: six seconds later nothing is left."""

from __future__ import annotations

import os
import signal
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.keeping import proc
from orchestra.values import Stop
from tests.pressure import Deadline
from tests.supervise.plans import assert_ended, launched, plan, process, ready_when, wait_for

if TYPE_CHECKING:
    from pathlib import Path

QUICK = Stop(timeout=0.5, kill_timeout=0.5)
FAMILY = process("family", "child", "escape=ignore", "daemon=ignore", "say=up", "linger", stop=QUICK)
STUBBORN = process("stubborn", "ignore=INT,TERM", "say=up", "linger", stop=QUICK)
POLITE = process("polite", "polite", "say=up", "linger")
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL)


@pytest.mark.parametrize("number", SIGNALS)
@pytest.mark.parametrize("target", ["orc-keeper", "orc-supervisor"])
def test_keeper_or_supervisor(tmp_path: Path, target: str, number: signal.Signals) -> None:
    with launched(tmp_path, plan(FAMILY, STUBBORN, POLITE)) as run:
        for name in ("family", "stubborn", "polite"):
            run.await_line(name, "up")
        before = run.everything()
        assert len(before) == 3 + 3 + 3
        os.kill(run.own(target), number)
        run.assert_gone()
        assert_ended(before)
        killed = {"orc-keeper": -signal.SIGKILL, "orc-supervisor": 1}[target]
        assert run.wait() == (killed if number == signal.SIGKILL else 128 + number)


def test_a_killed_supervisor_is_told(tmp_path: Path) -> None:
    with launched(tmp_path, plan(POLITE)) as run:
        run.await_line("polite", "up")
        os.kill(run.own("orc-supervisor"), signal.SIGKILL)
        assert run.wait() == 1
        last = run.stderr.splitlines()[-1]
        assert last == (
            "[orchestra] the supervisor was ended by SIGKILL; everything that it had started has been ended"
        )


@pytest.mark.parametrize("number", SIGNALS)
def test_the_resolver(tmp_path: Path, number: signal.Signals) -> None:
    with launched(tmp_path, ("wait",)) as run:
        os.kill(run.own("orc-resolver"), number)
        run.assert_gone()
        assert run.wait() == 1
        assert f"which reads the launch files, was ended by {number.name}; nothing was started" in run.stderr


@pytest.mark.parametrize("number", SIGNALS)
@pytest.mark.parametrize("target", ["orc-keeper", "orc-supervisor"])
def test_while_the_resolver_works(tmp_path: Path, target: str, number: signal.Signals) -> None:
    with launched(tmp_path, ("wait",)) as run:
        run.own("orc-resolver")
        os.kill(run.own(target), number)
        run.assert_gone()
        killed = {"orc-keeper": -signal.SIGKILL, "orc-supervisor": 1}[target]
        assert run.wait() == (killed if number == signal.SIGKILL else 128 + number)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL])
def test_an_observer_is_replaced(tmp_path: Path, number: signal.Signals) -> None:
    awaited = process("node", "say=up", "linger", ready=ready_when(message="/never"))
    with launched(tmp_path, plan(awaited, POLITE), environment={"ROS_DOMAIN_ID": "73"}) as run:
        run.await_line("polite", "up")
        first = run.own("orc-observer")
        os.kill(first, number)
        wait_for(lambda: run.own("orc-observer") != first, "another observer")
        before = run.everything()
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert_ended(before)


def test_a_supervisor_that_was_stopped_is_woken(tmp_path: Path) -> None:
    with launched(tmp_path, plan(POLITE)) as run:
        run.await_line("polite", "up")
        os.kill(run.own("orc-supervisor"), signal.SIGSTOP)
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert run.log("polite") == "up\nbye\n"


def test_ctrl_c_hurries_the_keeper_too(tmp_path: Path) -> None:
    with launched(tmp_path, plan(STUBBORN)) as run:
        run.await_line("stubborn", "up")
        deadline = Deadline(3.0)
        supervisor = run.own("orc-supervisor")
        os.kill(supervisor, signal.SIGKILL)
        wait_for(lambda: proc.stat(supervisor) is None, "the keeper to notice")
        run.send(signal.SIGINT)
        assert run.wait() == 1
        assert not deadline.is_over
        assert not run.everything()
