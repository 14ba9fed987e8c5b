"""SIGQUIT: what is told of a run, and that nothing changes by it."""

from __future__ import annotations

import os
import re
import signal
from functools import partial
from typing import TYPE_CHECKING

import pytest

from orchestra.plan.reactions import TriggerEvent
from orchestra.supervise.options import RunOptions
from orchestra.supervise.resolver import document
from tests.supervise.plans import (
    after,
    at_start,
    deferred,
    launched,
    log,
    plan,
    process,
    ready_when,
    wait_for,
    when,
)
from tests.supervise.test_terminal import in_terminal

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Plan

POLITE = process("polite", "polite", "say=up", "linger")


def written(folder: Path, what: Plan) -> str:
    """Write the document of a plan and return its path."""
    path = folder / "document.json"
    path.write_bytes(document.dumps(what, RunOptions()))
    return str(path)


def tells(path: Path, count: int) -> bool:
    """Whether so many dumps are in a file."""
    return path.exists() and path.read_text().count("in run_once") == count


@pytest.mark.parametrize("target", ["orc-keeper", "orc-supervisor"])
def test_it_tells_what_runs_what_is_waited_for_and_where_we_are(tmp_path: Path, target: str) -> None:
    slow = process(
        "slow", "polite", "say=begun", "linger", ready=ready_when(log="never comes", timeout=650.0)
    )
    behind = process("behind", "linger", depends_on=after("slow", "ready"))
    with launched(
        tmp_path, plan(POLITE, slow, behind, triggers=(at_start(log("late"), delay=750.0),))
    ) as run:
        run.await_line("polite", "up")
        run.await_line("slow", "begun")
        kept = run.directory / "dump.txt"
        for count in (1, 2):
            os.kill(run.own(target), signal.SIGQUIT)
            wait_for(partial(tells, kept, count), "the dump")
        dump = kept.read_text()
        for told in ("polite  running", "slow", "that matches 'never comes'"):
            assert told in dump
        assert re.search(r"timers:\n  in [56]\d\d\.(.*\n)+?  in [67]\d\d\.", dump)
        assert f"supervisor (pid {run.own('orc-supervisor')}):\n" in dump
        assert (f"keeper (pid {run.popen.pid}):\n" in dump) == (target == "orc-keeper")
        assert ("in until_it_ends" in dump) == (target == "orc-keeper")
        head = dump.split(" ", 2)[2].splitlines()[0]
        wait_for(lambda: head in run.stderr.replace("[orchestra] ", ""), "the same on the screen")
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert run.log("polite") == "up\nbye\n"
        assert {event.data["signal"] for event in run.of_kind("signal_sent")} == {"SIGINT"}


def test_it_tells_where_a_launch_file_hangs(tmp_path: Path) -> None:
    with launched(tmp_path, ("stuck.py", "-", "resolver")) as run:
        wait_for(lambda: "this is stuck" in run.stderr, "the resolver")
        run.send(signal.SIGQUIT)
        wait_for(lambda: "in prepare" in run.stderr, "the stack of the resolver")
        assert f"resolver (pid {run.own('orc-resolver')}):\n" in run.stderr
        assert 'stuck.py", line' in run.stderr
        assert "in stuck_for_ever" in run.stderr
        assert "the resolver has been reading the launch files" in run.stderr
        assert run.popen.poll() is None
        run.send(signal.SIGINT)
        assert run.wait() == 130


def test_it_tells_where_the_code_of_a_trigger_hangs(tmp_path: Path) -> None:
    trigger = when(TriggerEvent("run_started"), deferred(1))
    with launched(
        tmp_path, ("stuck.py", written(tmp_path, plan(POLITE, triggers=(trigger,))), "resolver")
    ) as run:
        wait_for(lambda: "this is stuck" in run.stderr, "the resolver")
        run.send(signal.SIGQUIT)
        wait_for(lambda: "in stuck_when_asked" in run.stderr, "the stack of the resolver")
        dump = run.directory / "dump.txt"
        wait_for(lambda: dump.exists() and "in stuck_when_asked" in dump.read_text(), "the same in the file")
        run.send(signal.SIGINT)
        assert run.wait() == 130


def test_a_resolver_that_cannot_answer_is_told(tmp_path: Path) -> None:
    with launched(tmp_path, ("wait",)) as run:
        wait_for(lambda: "resolving" in run.stderr, "the resolver")
        resolver = run.own("orc-resolver")
        os.kill(resolver, signal.SIGSTOP)
        run.send(signal.SIGQUIT)
        wait_for(
            lambda: f"resolver (pid {resolver}): it does not answer; its state is T" in run.stderr, "that"
        )
        os.kill(resolver, signal.SIGCONT)
        run.send(signal.SIGINT)
        assert run.wait() == 130


def test_a_dump_on_a_blocked_terminal_is_in_the_run_directory(tmp_path: Path) -> None:
    noisy = process("noisy", "bytes=1200000", "say=done", "linger")
    with in_terminal(tmp_path, noisy) as (run, terminal):
        run.await_line("noisy", "done")
        terminal.type(b"\x1c")
        kept = run.directory / "dump.txt"
        wait_for(lambda: kept.exists() and "in run_once" in kept.read_text(), "the dump")
        assert "noisy  running" in kept.read_text()
        run.send(signal.SIGINT)
        assert run.wait() == 130


def test_a_full_disk_is_told(tmp_path: Path) -> None:
    with launched(tmp_path, plan(POLITE)) as run:
        run.await_line("polite", "up")
        (run.directory / "dump.txt").symlink_to("/dev/full")
        run.send(signal.SIGQUIT)
        wait_for(lambda: "the state of the run could not be kept" in run.stderr, "the complaint")
        assert "in run_once" in run.stderr
        run.send(signal.SIGINT)
        assert run.wait() == 130


def test_a_supervisor_that_is_stuck_is_killed_in_the_end_and_it_is_told_where_it_was(tmp_path: Path) -> None:
    with launched(tmp_path, ("stuck.py", written(tmp_path, plan(POLITE)), "supervisor")) as run:
        wait_for(lambda: "this is stuck" in run.stderr, "the supervisor")
        run.send(signal.SIGINT)
        assert run.wait() == 1
        run.assert_gone()
        # On a busy machine it may still be about to wait.
        assert re.search(
            r"the supervisor does not answer \(state [RS]\); it is killed after 8 s\n", run.stderr
        )
        assert "it was here:\n" in run.stderr
        assert "in stuck_when_the_run_begins" in run.stderr
