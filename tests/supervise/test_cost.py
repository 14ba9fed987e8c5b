"""What a process costs: system calls for its start and its end, and no memory once it has gone. Counted, never timed."""

from __future__ import annotations

import re
import shutil
import signal
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.loop import Loop
from orchestra.values import Restart
from tests.supervise.effort import memory
from tests.supervise.plans import launched, plan, process, wait_for

if TYPE_CHECKING:
    from pathlib import Path

    from tests.supervise.plans import Launched

# Calls of the supervisor's two threads for one more program that starts, says nothing and ends: two pipes (pipe2,
# close, FIONBIO, read to the end), what posix_spawn does, which looks at the action of every signal in the child before
# the program begins, limits, a pidfd, epoll, waitid, wait4, and what is written of it.
_MOST_CALLS = 40
# How often the two threads wait for each other at the lock of the interpreter is a matter of time; so is how many events
# are written at a time, from one, of five that a program has, to all of them.
_VARYING, _WRITTEN, _MOST_WRITTEN = "futex", "writev", 6
# In how many rounds of the loop programs end is one too, and each looks into /proc: a file that the interpreter opens
# and reads takes so many calls.
_PER_FILE, _MOST_FILES = 9, 3
_FEW, _MANY = 20, 60
# What the interpreter keeps of what it has freed moves by some hundred kilobytes.
_KEPT_AT_MOST = 400 * 1024
_ALWAYS = Restart("always", min_uptime=0.0)


@pytest.mark.timeout(300)  # strace(1) stops a program twice for each call
@pytest.mark.skipif(shutil.which("strace") is None, reason="counts system calls with strace(1)")
def test_a_start_and_an_end_take_few_calls(tmp_path: Path) -> None:
    calls = {count: _calls(tmp_path / str(count), count) for count in (_FEW, _MANY)}
    more = {
        name: (calls[_MANY].get(name, 0) - calls[_FEW].get(name, 0)) / (_MANY - _FEW) for name in calls[_MANY]
    }
    told = {name: round(count, 2) for name, count in more.items() if count > 0.1 and name != _VARYING}
    files = told.get("openat", 0)
    written = told.get(_WRITTEN, 0)
    assert sum(told.values()) - files * _PER_FILE - written <= _MOST_CALLS, str(told)
    assert written <= _MOST_WRITTEN
    assert files <= _MOST_FILES
    assert told["pidfd_open"] == 1
    assert not {"fork", "vfork", "clone"} & told.keys()


def _calls(folder: Path, count: int) -> dict[str, int]:
    """Return the system calls of a supervisor for so many programs that end at once; those of programs do not count."""
    folder.mkdir()
    out = folder / "calls"
    short = [process(f"p{n}", command=("/bin/true",)) for n in range(count)]
    tracer = ("strace", "-f", "-qq", "-o", str(out), "--")
    with launched(folder, plan(*short), through=tracer) as run:
        assert run.wait(120.0) == 0
        supervisor = run.of_kind("run_started")[0].pid
    return _counted(out.read_text("utf-8", "replace"), supervisor or 0)


def _counted(text: str, supervisor: int) -> dict[str, int]:
    """Count the calls of one process and its threads: these are made with CLONE_THREAD, programs are not."""
    ours = {str(supervisor)}
    found: dict[str, int] = {}
    for pid, name, rest in re.findall(r"(?m)^(\d+) +(\w+)\((.*)$", text):
        if pid not in ours:
            continue
        found[name] = found.get(name, 0) + 1
        thread = re.search(r"CLONE_THREAD.*= (\d+)", rest)
        if thread:
            ours.add(thread[1])
    return found


def _restarted(run: Launched, count: int, seconds: float) -> None:
    """Wait until so many runs have ended; the file grows with them, so it is not read again and again."""
    path = run.directory / "events.jsonl"
    run.await_event("process_running")
    wait_for(lambda: path.read_bytes().count(b'"process_ended"') >= count, f"{count} ends", seconds)


def _growth(folder: Path, first: int, then: int, seconds: float) -> int:
    """Return by how many bytes a supervisor has grown from one number of restarts to another."""
    command = ("/bin/sh", "-c", "echo out; echo err >&2")
    again = process("again", command=command, restart=_ALWAYS)
    with launched(folder, plan(again, process("stays", "linger"))) as run:
        _restarted(run, first, seconds)
        supervisor = run.own("orc-supervisor")
        before = memory(supervisor)
        _restarted(run, then, seconds)
        grown = memory(supervisor) - before
        run.send(signal.SIGINT)
        assert run.wait(60.0) == 130
    return grown


def test_restarts_leave_nothing_in_memory(tmp_path: Path) -> None:
    assert _growth(tmp_path, 200, 600, 60.0) < _KEPT_AT_MOST


@pytest.mark.long
@pytest.mark.timeout(900)
def test_ten_thousand_restarts_leave_nothing_in_memory(tmp_path: Path) -> None:
    assert _growth(tmp_path, 500, 10_500, 800.0) < _KEPT_AT_MOST


def test_timers_that_were_taken_back_are_not_kept() -> None:
    loop = Loop()
    kept = loop.call_later(60.0, lambda: None)
    for _ in range(10_000):
        loop.call_later(60.0, lambda: None).cancel()
    assert len(loop._timers) < 1000
    assert [name for _, name in loop.pending()] == [kept.name]
    loop.close()
