"""Keeper and supervisor killed in the same instant: the guard ends what is left.

Where it is killed with them, in the one case in which something stays, the next command says so.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from typing import TYPE_CHECKING

from orchestra.supervise.keeping import proc
from tests.supervise.plans import (
    PROCESSES,
    alive,
    assert_ended,
    launched,
    name_of,
    plan,
    process,
    ready_when,
    wait_for,
)

if TYPE_CHECKING:
    from pathlib import Path

    from tests.supervise.plans import Launched

FAMILY = process("family", "child=ignore", "escape=ignore", "daemon", "say=up", "linger")
BELOW = 3
STUBBORN = process("stubborn", "ignore=INT,TERM", "say=up", "linger")
AWAITED = process("awaited", "say=up", "linger", ready=ready_when(message="/never"))
OURS = ("orc-keeper", "orc-supervisor")
ALL_OF_OURS = (*OURS, "orc-guard")


def kill_both(run: Launched, names: tuple[str, ...] = OURS) -> None:
    """None has the time to do anything about the end of the others: all are stopped when they are killed."""
    pids = [run.own(name) for name in names]
    for number in (signal.SIGSTOP, signal.SIGKILL):
        for pid in reversed(pids):
            os.kill(pid, number)
    run.popen.wait()
    wait_for(lambda: not any(map(alive, pids)), "the end of these")


def orchestra(run: Launched, *words: str) -> subprocess.CompletedProcess[str]:
    """Run a command beside a run, in the same environment."""
    environment = {**os.environ, "ORCHESTRA_HOME": str(run.home), "XDG_RUNTIME_DIR": str(run.home.parent)}
    command = [sys.executable, "-m", "orchestra", *words]
    return subprocess.run(
        command,
        env=environment,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )


def sockets(folder: Path) -> list[Path]:
    return [path for path in folder.rglob("*") if path.is_socket()]


def test_without_a_guard_all_is_left_and_the_next_command_says_so(tmp_path: Path) -> None:
    environment = {"XDG_RUNTIME_DIR": str(tmp_path)}
    with launched(tmp_path, plan(FAMILY, STUBBORN), environment=environment) as run:
        for name in ("family", "stubborn"):
            run.await_line(name, "up")
        before = run.everything()
        kill_both(run, ALL_OF_OURS)
        left = run.everything()
        marks = sorted(str(proc.marks(pid, ("ORCHESTRA_PROCESS",))[0]) for pid in left)
        assert marks == [*["family"] * (1 + BELOW), "stubborn"]

        told = orchestra(run, "ps")
        assert "died and left 5 processes: " in told.stderr
        assert run.everything() == left

        cleaned = orchestra(run, "clean", "--yes")
        assert cleaned.returncode == 0, cleaned.stderr
        assert_ended(before)
        assert not sockets(tmp_path)
        assert "died" not in orchestra(run, "ps").stderr


def test_the_guard_ends_what_does_not_heed_sigterm(tmp_path: Path) -> None:
    with launched(tmp_path, plan(FAMILY, STUBBORN), environment={"XDG_RUNTIME_DIR": str(tmp_path)}) as run:
        for name in ("family", "stubborn"):
            run.await_line(name, "up")
        before = run.everything()
        kill_both(run)
        run.assert_gone()
        assert_ended(before)
        assert not sockets(tmp_path)


def test_what_is_ours_ends_by_itself(tmp_path: Path) -> None:
    environment = {"XDG_RUNTIME_DIR": str(tmp_path), "ROS_DOMAIN_ID": "45"}
    with launched(tmp_path, plan(AWAITED), environment=environment) as run:
        run.await_line("awaited", "up")
        observer = run.own("orc-observer")
        kill_both(run)
        wait_for(lambda: not alive(observer), "the end of the observer", 10.0)
        run.assert_gone()


def test_a_resolver_ends_with_them(tmp_path: Path) -> None:
    with launched(tmp_path, ("wait",)) as run:
        wait_for(lambda: "resolving" in run.stderr, "the resolver")
        assert name_of(run.own("orc-resolver")) == "orc-resolver"
        kill_both(run)
        run.assert_gone()


def test_a_supervisor_that_fails_after_the_keeper_was_killed_ends_everything_itself(tmp_path: Path) -> None:
    through = (sys.executable, str(PROCESSES / "failing.py"))
    with launched(tmp_path, plan(FAMILY, STUBBORN), through=through) as run:
        for name in ("family", "stubborn"):
            run.await_line(name, "up")
        before = run.everything()
        os.kill(run.own("orc-keeper"), signal.SIGKILL)
        wait_for(lambda: not any(map(alive, before)), "the end of everything")
        assert "this is a bug in Orchestra: RuntimeError: a bug of the supervisor, at signal 15" in run.stderr
