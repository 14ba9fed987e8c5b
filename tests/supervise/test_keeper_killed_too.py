"""Keeper and supervisor killed at once: what the programs started is left, and can be found and ended."""

from __future__ import annotations

import os
import signal
from typing import TYPE_CHECKING

import pytest

from orchestra.control import remains
from orchestra.supervise.keeping import proc
from orchestra.supervise.keeping.marks import RUN, number_of, run_mark, run_of
from tests.supervise.plans import alive, assert_ended, launched, plan, process, stand_in, wait_for

if TYPE_CHECKING:
    from pathlib import Path

PLAIN = process("plain", "say=up", "linger")
FAMILY = process("family", "child", "escape", "daemon", "anonymous", "say=up", "linger")


@pytest.mark.parametrize("first", ["keeper", "supervisor"])
def test_programs_end_and_what_they_left_is_found(tmp_path: Path, first: str) -> None:
    with launched(tmp_path, plan(PLAIN, FAMILY)) as run:
        for name in ("plain", "family"):
            run.await_line(name, "up")
        ours = [run.own("orc-keeper"), run.own("orc-supervisor")]
        programs = {event.pid for event in run.of_kind("process_running")}
        below = run.everything() - {*ours, *programs}
        assert len(below) == 4
        (mark,) = proc.marks(min(pid for pid in programs if pid), (RUN,))
        assert mark
        for pid in ours if first == "keeper" else reversed(ours):
            os.kill(pid, signal.SIGKILL)
        run.popen.wait()
        wait_for(lambda: not any(alive(pid) for pid in (*programs, *ours) if pid), "the end of the programs")
        left = {pid for pid in below if alive(pid)}
        assert {remnant.pid for remnant in remains.remnants([mark])} == left
        assert not remains.end([mark])
        assert_ended(below)


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
