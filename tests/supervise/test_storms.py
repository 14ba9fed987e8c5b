"""Processes that multiply while they are being ended, that are stopped, or traced."""

from __future__ import annotations

import ctypes
import os
import signal
import sys
import time
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.keeping import proc
from orchestra.values import Stop
from tests.supervise.plans import PROCESSES, launched, name_of, plan, process, stand_in, wait_for

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from orchestra.plan.model import Process
    from tests.supervise.plans import Launched

QUICK = Stop(timeout=0.3, kill_timeout=0.3)


def storm(words: str, mark: str) -> Process:
    """Return a process that multiplies; the mark stands in the command line of each of them."""
    command = (sys.executable, "-S", "-E", str(PROCESSES / "storm.py"), words, mark)
    return process("a", command=command, stop=QUICK)


def seen(mark: str, seconds: float) -> set[int]:
    """Look for a while for processes with a mark: what forks and ends all the time is not there at every look."""
    deadline = time.monotonic() + seconds
    found: set[int] = set()
    while time.monotonic() < deadline:
        found.update(pid for pid in proc.pids() if mark in proc.command(pid) and not ours(pid))
    return found


def ours(pid: int) -> bool:
    return pid == os.getpid() or name_of(pid).startswith("orc-")


def _stop(run: Launched) -> int:
    run.send(signal.SIGINT)
    return 130


def _without_supervisor(run: Launched) -> int:
    os.kill(run.own("orc-supervisor"), signal.SIGKILL)
    return 1


def _without_keeper(run: Launched) -> int:
    run.send(signal.SIGKILL)
    return -signal.SIGKILL


@pytest.mark.parametrize(
    ("words", "attack"),
    [
        ("pairs=25", _stop),
        ("pairs=25", _without_supervisor),
        ("comets=3", _stop),
        pytest.param("pairs=25", _without_keeper, marks=pytest.mark.long),
        pytest.param("comets=3", _without_keeper, marks=pytest.mark.long),
        pytest.param("comets=3", _without_supervisor, marks=pytest.mark.long),
    ],
)
def test_a_storm_ends(tmp_path: Path, words: str, attack: Callable[[Launched], int]) -> None:
    mark = f"mark={tmp_path}"
    with launched(tmp_path, plan(storm(words, mark))) as run:
        run.await_line("a", "up")
        assert seen(mark, 0.5)
        status = attack(run)
        run.assert_gone(8.0)
        assert run.wait() == status
    assert not seen(mark, 0.5)


@pytest.mark.parametrize("attack", [_stop, _without_supervisor])
def test_stopped_members_end(tmp_path: Path, attack: Callable[[Launched], int]) -> None:
    """Some in the group, some in sessions of their own, some detached: all of them are stopped."""
    with launched(
        tmp_path, plan(process("a", "child", "escape", "daemon", "polite", "say=up", "linger"))
    ) as run:
        run.await_line("a", "up")
        ours = {run.popen.pid, run.own("orc-supervisor")}
        for pid in run.everything() - ours:
            os.kill(pid, signal.SIGSTOP)
        status = attack(run)
        run.assert_gone()
        assert run.wait() == status


TRACER = """
import ctypes, os, signal, sys
libc = ctypes.CDLL(None)
tracee = os.fork()
if tracee == 0:
    libc.ptrace(0, 0, 0, 0)
    os.kill(os.getpid(), signal.SIGSTOP)
    while True:
        signal.pause()
os.waitpid(tracee, 0)
print("up", flush=True)
for number in (signal.SIGINT, signal.SIGTERM):
    signal.signal(number, signal.SIG_IGN)
while True:
    signal.pause()
"""


@pytest.mark.parametrize("attack", [_stop, pytest.param(_without_supervisor, marks=pytest.mark.long)])
def test_what_a_process_of_the_plan_traces_ends(tmp_path: Path, attack: Callable[[Launched], int]) -> None:
    words = (sys.executable, "-S", "-E", "-c", TRACER)
    with launched(tmp_path, plan(process("a", command=words, stop=QUICK))) as run:
        run.await_line("a", "up")
        status = attack(run)
        run.assert_gone()
        assert run.wait() == status


def state(pid: int) -> str | None:
    facts = proc.stat(pid)
    return facts.state if facts else None


class Tracer:
    """Holds a process at its end, so that not even SIGKILL gets it away (ptrace(2), PTRACE_O_TRACEEXIT)."""

    _SEIZE, _TRACE_EXIT, _DETACH = 0x4206, 0x40, 17

    def __init__(self) -> None:
        self._libc = ctypes.CDLL(None, use_errno=True)
        self._libc.ptrace.argtypes = (ctypes.c_long, ctypes.c_long, ctypes.c_void_p, ctypes.c_void_p)

    def seize(self, pid: int) -> None:
        if self._libc.ptrace(self._SEIZE, pid, None, self._TRACE_EXIT):
            pytest.skip(f"no process may be traced here: {os.strerror(ctypes.get_errno())}")

    def release(self, pid: int) -> None:
        """Let it go, and wait until it has ended."""
        os.waitpid(pid, 0x40000000)  # __WALL
        self._libc.ptrace(self._DETACH, pid, None, None)


def test_what_nothing_can_end_is_named(tmp_path: Path) -> None:
    with launched(tmp_path, plan(process("a", "say=up", "linger", stop=QUICK))) as run:
        run.await_line("a", "up")
        pid = run.of_kind("process_running", "a")[0].pid
        assert pid
        tracer = Tracer()
        tracer.seize(pid)
        try:
            run.send(signal.SIGINT)
            assert run.wait() == 4
            assert run.events[-1].data == {"status": 4, "reason": f"could not be stopped: a (pid {pid})"}
            assert f"could not be stopped: a (pid {pid})" in run.stderr.splitlines()[-1]
        finally:
            tracer.release(pid)
        run.assert_gone()


def test_a_keeper_names_what_it_cannot_end_too(tmp_path: Path) -> None:
    with launched(tmp_path, plan(process("a", "say=up", "linger", stop=QUICK))) as run:
        run.await_line("a", "up")
        pid = run.of_kind("process_running", "a")[0].pid
        assert pid
        tracer = Tracer()
        tracer.seize(pid)
        try:
            os.kill(run.own("orc-supervisor"), signal.SIGKILL)
            assert run.wait() == 4
            command = " ".join(stand_in("say=up", "linger"))
            assert run.stderr.splitlines()[-1] == (
                f"[orchestra] the supervisor was ended by SIGKILL; could not be ended: {command} (pid {pid})"
            )
        finally:
            tracer.release(pid)
        run.assert_gone()


@pytest.mark.long
def test_a_supervisor_that_nothing_can_end_does_not_keep_the_keeper(tmp_path: Path) -> None:
    with launched(tmp_path, plan(process("a", "polite", "say=up", "linger"))) as run:
        run.await_line("a", "up")
        supervisor = run.own("orc-supervisor")
        tracer = Tracer()
        tracer.seize(supervisor)
        try:
            os.kill(supervisor, signal.SIGKILL)
            wait_for(lambda: state(supervisor) == "t", "the supervisor to be held at its end")
            run.send(signal.SIGINT)
            assert run.wait() == 4
            assert "the supervisor cannot be ended; could not be ended: " in run.stderr
            assert f"(pid {supervisor})" in run.stderr.splitlines()[-1]
        finally:
            tracer.release(supervisor)
        run.assert_gone()
