"""What processes start themselves: nothing of it is left, and it is known whose it was."""

from __future__ import annotations

import os
import signal
import sys
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.keeping import proc
from orchestra.supervise.options import RunOptions
from orchestra.supervise.resolver import document
from orchestra.values import Restart, Stop
from tests.supervise.plans import (
    PROCESSES,
    alive,
    assert_ended,
    finished,
    launched,
    name_of,
    plan,
    process,
    stand_in,
)

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Process

KINDS = ("child", "escape", "daemon", "anonymous")
QUICK = Stop(timeout=0.3, kill_timeout=0.3)


@pytest.mark.conforms("4.9 6", "D31")
@pytest.mark.parametrize("manner", ["", "=ignore"])
@pytest.mark.parametrize("kind", KINDS)
def test_a_stop_ends_all_of_it(tmp_path: Path, kind: str, manner: str) -> None:
    with launched(
        tmp_path, plan(process("a", f"{kind}{manner}", "polite", "say=up", "linger", stop=QUICK))
    ) as run:
        run.await_line("a", "up")
        before = run.everything()
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert_ended(before)


@pytest.mark.parametrize("kind", KINDS)
def test_a_program_that_leaves_something_behind(tmp_path: Path, kind: str) -> None:
    """Its own end is what it was; what it left is ended and named."""
    run = finished(tmp_path, plan(process("a", f"{kind}=ignore", "exit=3", required=True, stop=QUICK)))
    assert run.popen.returncode == 3
    left = run.of_kind("left_behind")
    assert [event.process for event in left] == ["a"]
    assert "stand_in.py" in left[0].data["command"]


def test_a_restart_waits_until_nothing_is_left(tmp_path: Path) -> None:
    again: Process = process("a", "child=ignore", "exit=3", stop=QUICK, restart=Restart("always", budget=1))
    run = finished(tmp_path, plan(again))
    kinds = run.kinds("a")
    assert kinds.count("process_starting") == 2
    first = kinds[: kinds.index("process_restarting")]
    assert first.count("signal_sent") == 3


def test_a_fork_storm_ends(tmp_path: Path) -> None:
    storm = "for i in 1 2 3 4 5 6 7 8 9 10; do for j in 1 2 3 4 5; do setsid sleep 1000 & done; done; echo up; wait"
    with launched(tmp_path, plan(process("a", command=("/bin/sh", "-c", storm)))) as run:
        run.await_line("a", "up")
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert not run.everything()


def test_a_program_without_its_marks_ends_too(tmp_path: Path) -> None:
    words = ("/usr/bin/env", "-i", *stand_in("escape", "say=up", "linger"))
    with launched(tmp_path, plan(process("a", command=words))) as run:
        run.await_line("a", "up")
        before = run.everything()
        run.send(signal.SIGTERM)
        assert run.wait() == 143
        assert_ended(before)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_a_run_may_be_part_of_a_run(tmp_path: Path, number: signal.Signals) -> None:
    """Killing the inner supervisor leaves the inner keeper to end what it had; stopping the outer run stops both."""
    inner_document = tmp_path / "inner.json"
    inner_document.write_bytes(
        document.dumps(plan(process("node", "daemon", "say=up", "linger")), RunOptions())
    )
    words = (sys.executable, str(PROCESSES / "launcher.py"), str(inner_document))
    home: dict[str, str | None] = {"ORCHESTRA_HOME": str(tmp_path / "inner")}
    with launched(tmp_path, plan(process("inner", command=words, environment=home))) as run:
        run.await_line("inner", "[node] up")
        before = run.everything()
        if number == signal.SIGKILL:
            inner = [pid for pid in proc.descendants(run.popen.pid) if name_of(pid) == "orc-supervisor"]
            os.kill(inner[-1], signal.SIGKILL)
            assert run.wait() == 0
            assert run.events[-1].data["reason"].endswith("failed: inner (exit code 1)")
        else:
            run.send(number)
            assert run.wait() == 130
        assert_ended(before)


def test_nobody_else_is_touched(tmp_path: Path) -> None:
    """A bystander in our own process group and session stays."""
    bystander = os.posix_spawn("/bin/sleep", ["sleep", "1000"], dict(os.environ))
    try:
        with launched(tmp_path, plan(process("a", "daemon=ignore", "say=up", "linger", stop=QUICK))) as run:
            run.await_line("a", "up")
            run.send(signal.SIGINT)
            assert run.wait() == 130
        assert alive(bystander)
    finally:
        os.kill(bystander, signal.SIGKILL)
        os.waitpid(bystander, 0)
