"""Keeper and supervisor killed at once: the guard ends everything, and where it was killed too all can be found."""

from __future__ import annotations

import os
import signal
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.keeping import proc, remnants
from orchestra.supervise.keeping.marks import RUN, number_of, run_mark, run_of
from tests.supervise.plans import alive, assert_ended, launched, plan, process, stand_in, wait_for

if TYPE_CHECKING:
    from tests.supervise.plans import Launched

PLAIN = process("plain", "say=up", "linger")
FAMILY = process("family", "child", "escape", "daemon", "anonymous", "say=up", "linger")
STUBBORN = process("stubborn", "ignore=INT,TERM", "say=up", "linger")
# The guard takes 5 s for those that ignore what is asked of them, and a busy machine is slow to let it begin.
_LONG = 20.0
OURS = ("orc-keeper", "orc-supervisor", "orc-guard")


@pytest.mark.parametrize("first", ["keeper", "supervisor"])
def test_the_guard_ends_everything(tmp_path: Path, first: str) -> None:
    with launched(tmp_path, plan(PLAIN, FAMILY, STUBBORN), environment=_folder(tmp_path)) as run:
        _await_all(run)
        ours = [run.own(name) for name in OURS[:2]]
        before = run.everything() | {run.own("orc-guard")}
        for pid in ours if first == "keeper" else reversed(ours):
            os.kill(pid, signal.SIGKILL)
        run.popen.wait()
        run.assert_gone(_LONG)
        assert_ended(before)
        assert not [path for path in tmp_path.rglob("*") if path.is_socket()]


def test_a_keeper_that_is_killed_while_it_sweeps_leaves_the_rest_to_the_guard(tmp_path: Path) -> None:
    with launched(tmp_path, plan(PLAIN, STUBBORN), environment=_folder(tmp_path)) as run:
        run.await_line("plain", "up")
        run.await_line("stubborn", "up")
        plain = run.of_kind("process_running", "plain")[0].pid or 0
        before = run.everything() | {run.own("orc-guard")}
        os.kill(run.own("orc-supervisor"), signal.SIGKILL)
        wait_for(lambda: not alive(plain), "the end of the one that does what it is asked")
        os.kill(run.popen.pid, signal.SIGKILL)
        run.popen.wait()
        run.assert_gone(_LONG)
        assert_ended(before)


def test_without_a_guard_what_is_left_is_found(tmp_path: Path) -> None:
    with launched(tmp_path, plan(PLAIN, FAMILY, STUBBORN)) as run:
        _await_all(run)
        ours = [run.own(name) for name in OURS]
        below = run.everything() - {*ours}
        assert len(below) == 7
        (mark,) = proc.marks(min(below), (RUN,))
        assert mark
        for number in (signal.SIGSTOP, signal.SIGKILL):
            for pid in ours:
                os.kill(pid, number)
        run.popen.wait()
        assert_ended({*ours})
        assert {remnant.pid for remnant in remnants.remnants([mark])} == below
        assert not remnants.end([mark])
        assert_ended(below)


def test_a_guard_that_is_killed_is_replaced(tmp_path: Path) -> None:
    with launched(tmp_path, plan(PLAIN)) as run:
        run.await_line("plain", "up")
        first = run.own("orc-guard")
        os.kill(first, signal.SIGKILL)
        wait_for(lambda: run.own("orc-guard") != first, "another guard")
        run.send(signal.SIGINT)
        assert run.wait() == 130
        run.assert_gone()


def test_a_guard_is_not_found_by_our_name_and_holds_nothing(tmp_path: Path) -> None:
    with launched(tmp_path, plan(PLAIN)) as run:
        run.await_line("plain", "up")
        guard = run.own("orc-guard")
        wait_for(lambda: proc.command(guard) == "orc-guard", "its name")
        wait_for(lambda: _opened(guard) == 3 * [os.devnull] + 2 * ["pidfd"], "what it keeps open")
        run.send(signal.SIGINT)
        assert run.wait() == 130


def _opened(pid: int) -> list[str]:
    """Return what a process has open, by descriptor; a pidfd has another name in every kernel (pidfs)."""
    folder = Path(f"/proc/{pid}/fd")
    names = [(int(path.name), str(path.readlink())) for path in folder.iterdir()]
    return ["pidfd" if "pidfd" in name else name for _, name in sorted(names)]


def _await_all(run: Launched) -> None:
    for name in ("plain", "family", "stubborn"):
        run.await_line(name, "up")


def _folder(path: Path) -> dict[str, str]:
    return {"XDG_RUNTIME_DIR": str(path)}


def test_a_program_that_has_lost_everything_is_attributed(tmp_path: Path) -> None:
    """No environment, no parent, a session of its own: its number tells whose it was."""
    command = ("/usr/bin/env", "-i", *stand_in("anonymous", "say=up", "linger"))
    with launched(tmp_path, plan(PLAIN, process("bare", command=command))) as run:
        run.await_line("bare", "up")
        run.await_line("plain", "up")
        os.kill(run.of_kind("process_running", "bare")[0].pid or 0, signal.SIGKILL)
        adopted = run.await_event("descendant_adopted", "bare")
        assert "stand_in.py" in adopted.data["command"]
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert not run.everything()


def test_numbers_tell_runs_and_processes_apart() -> None:
    one, other = run_mark(1_700_000_000_000_000_000, 1), run_mark(1_700_000_000_000_001_000, 1)
    numbers = [number_of(run, process) for run in (one, other) for process in (0, 1, 2)]
    assert len(set(numbers)) == len(numbers)
    assert [run_of(number, [one, other]) for number in numbers if number is not None] == [one] * 3 + [
        other
    ] * 3
    assert run_of(0, [one, other]) is None
    assert number_of("no mark") is None
