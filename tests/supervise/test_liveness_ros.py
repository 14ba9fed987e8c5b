"""Signs of life and readiness that are seen in the ROS graph."""

from __future__ import annotations

import os
import signal
import sys
from typing import TYPE_CHECKING

from orchestra.plan.conditions import Alive
from tests.supervise.plans import PROCESSES, launched, name_of, plan, process, wait_for
from tests.supervise.test_readiness import ready, text

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Process
    from tests.supervise.plans import Launched

_DOMAIN = {"ROS_DOMAIN_ID": "60", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}


def publisher(alive: Alive) -> Process:
    """Return a node that publishes on /scan ten times a second."""
    command = (sys.executable, str(PROCESSES / "publisher.py"), "/scan,RELIABLE,VOLATILE,0")
    conditions = ready(log="up", topic="/scan", message="/scan", node="/publisher", timeout=60.0)
    return process("publisher", command=command, ready=conditions, alive=alive)


def observers(run: Launched) -> list[int]:
    return [pid for pid in run.everything() if name_of(pid) == "orc-observer"]


def test_too_few_messages_are_a_hang(tmp_path: Path) -> None:
    """All of several facts make it ready; a rate that it never reaches is missed from the beginning."""
    alive = Alive(message="/scan", min_rate=200.0, window=0.5)
    with launched(tmp_path, plan(publisher(alive)), environment=_DOMAIN) as run:
        reason = run.await_event("process_hung", "publisher").data["reason"]
        run.wait()
    assert reason.endswith("on /scan for 0.5 s, at least 200 a second are wanted")
    assert (
        "waiting for publisher: a line of its output that matches 'up', the node /publisher, "
        "a publisher on /scan and a message on /scan"
    ) in text(run)
    assert run.of_kind("process_ready", "publisher")
    assert run.kinds("publisher")[-1] == "process_failed"


def test_the_death_of_the_observer_is_no_hang(tmp_path: Path) -> None:
    """A new one takes its place, and sees the messages again."""
    alive = Alive(message="/scan", min_rate=2.0, window=0.5)
    with launched(tmp_path, plan(publisher(alive)), environment=_DOMAIN) as run:
        run.await_event("process_ready", "publisher")
        (first,) = wait_for(lambda: observers(run), "the observer")
        os.kill(first, signal.SIGKILL)
        wait_for(lambda: [pid for pid in observers(run) if pid != first], "another observer")
        assert not run.of_kind("process_hung")
        run.send(signal.SIGINT)
        assert run.wait() == 130
        run.assert_gone()
    assert not run.of_kind("process_hung")
