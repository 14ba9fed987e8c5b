"""Every exit status of a run, from real runs."""

from __future__ import annotations

import os
import signal
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.keeping import proc
from orchestra.supervise.options import RunOptions
from orchestra.values import Restart
from tests.supervise.plans import (
    after,
    at_start,
    finished,
    launched,
    log,
    plan,
    process,
    ready_when,
    shutdown,
    start,
    wait_for,
    when_ended,
)

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Plan

LINGERS = process("lingers", "polite", "linger")


@pytest.mark.conforms("4.1 6", "D29", "4.8 required", "4.9 9")
@pytest.mark.parametrize(
    ("what", "options", "status", "reason"),
    [
        (plan(), RunOptions(), 0, "every process has ended"),
        (plan(process("a", "exit=0")), RunOptions(), 0, "every process has ended"),
        (plan(process("a", "exit=3")), RunOptions(), 0, "every process has ended; failed: a (exit code 3)"),
        (plan(process("a", "kill=SEGV")), RunOptions(), 0, "every process has ended; failed: a (SIGSEGV)"),
        (
            plan(process("a", "exit=3")),
            RunOptions(fail_on_any=True),
            1,
            "every process has ended, and one failed; failed: a (exit code 3)",
        ),
        (
            plan(process("a", "exit=3", success_exit_codes=(0, 3))),
            RunOptions(fail_on_any=True),
            0,
            "every process has ended",
        ),
        (
            plan(process("a", "exit=0", required=True), LINGERS),
            RunOptions(),
            0,
            "required process a has ended",
        ),
        (
            plan(process("a", "exit=77", required=True), LINGERS),
            RunOptions(),
            77,
            "required process a failed (exit code 77)",
        ),
        (
            plan(process("a", "kill=ABRT", required=True), LINGERS),
            RunOptions(),
            134,
            "required process a failed (SIGABRT)",
        ),
        (
            plan(process("a", command=("/no/such/program",), required=True), LINGERS),
            RunOptions(),
            127,
            "required process a failed (could not be started: no such file or directory: /no/such/program)",
        ),
        (
            plan(process("a", command=("/etc/passwd",), required=True), LINGERS),
            RunOptions(),
            126,
            "required process a failed (could not be started: permission denied: /etc/passwd)",
        ),
        (
            plan(process("a", "linger", ready=ready_when(log="never", timeout=0.3)), LINGERS),
            RunOptions(),
            1,
            "a was not ready within 0.3 s: waited for a line of its output that matches 'never'",
        ),
        (
            plan(
                process("a", "exit=1"),
                process("b", required=True, depends_on=after("a", "completed")),
                LINGERS,
            ),
            RunOptions(),
            1,
            "required process b could not begin: a never was completed; failed: a (exit code 1)",
        ),
        (plan(LINGERS, triggers=(at_start(shutdown("enough")),)), RunOptions(), 0, "shut down: enough"),
        (
            plan(
                process("a", "exit=77", required=True),
                LINGERS,
                triggers=(when_ended("a", shutdown("a ended")),),
            ),
            RunOptions(),
            77,
            "required process a failed (exit code 77)",
        ),
    ],
)
def test_a_run_that_ends_by_itself(
    tmp_path: Path, what: Plan, options: RunOptions, status: int, reason: str
) -> None:
    run = finished(tmp_path, what, options)
    assert run.popen.returncode == status
    last = run.events[-1]
    assert (last.kind, last.data) == ("run_ended", {"status": status, "reason": reason})
    assert run.stderr.splitlines()[-1] == f"[orchestra] run ended with status {status}: {reason}"


@pytest.mark.conforms("D29", "4.9 1")
@pytest.mark.parametrize(
    ("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)]
)
def test_a_run_that_is_stopped(tmp_path: Path, number: signal.Signals, status: int) -> None:
    """What processes make of the stop is no failure, whatever their status."""
    stubborn = process("b", "polite=9", "say=up", "linger", required=True)
    with launched(
        tmp_path, plan(process("a", "say=up", "linger"), stubborn), RunOptions(fail_on_any=True)
    ) as run:
        run.await_line("a", "up")
        run.await_line("b", "up")
        run.send(number)
        assert run.wait() == status
        assert not run.everything()
        assert run.events[-1].data == {"status": status, "reason": f"stopped by {number.name}"}


def test_a_required_failure_counts_more_than_the_signal_that_follows(tmp_path: Path) -> None:
    stubborn = process("b", "ignore=INT,TERM", "say=up", "linger")
    failing = process("a", "exit=5", required=True, depends_on=after("b", "ready"))
    with launched(
        tmp_path, plan(process("b", command=stubborn.command, ready=ready_when("up")), failing)
    ) as run:
        run.await_event("run_stopping")
        run.send(signal.SIGINT)
        assert run.wait() == 5


def test_a_required_failure_counts_more_than_the_signal_that_comes_with_it(tmp_path: Path) -> None:
    """The supervisor hears of both at once."""
    with launched(tmp_path, plan(process("a", "say=up", "linger", required=True), LINGERS)) as run:
        run.await_line("a", "up")
        supervisor, pid = run.own("orc-supervisor"), run.of_kind("process_running", "a")[0].pid
        assert pid
        os.kill(supervisor, signal.SIGSTOP)
        os.kill(pid, signal.SIGKILL)
        wait_for(lambda: (stat := proc.stat(pid)) and stat.state == "Z", "its end")
        os.kill(supervisor, signal.SIGINT)
        os.kill(supervisor, signal.SIGCONT)
        assert run.wait() == 137
        assert run.events[-1].data["reason"].startswith("required process a failed")


def test_what_fails_before_the_stop_is_named(tmp_path: Path) -> None:
    crash = process("a", "exit=4")
    with launched(tmp_path, plan(crash, LINGERS)) as run:
        run.await_event("process_failed", "a")
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert run.events[-1].data["reason"] == "stopped by SIGINT; failed: a (exit code 4)"


@pytest.mark.conforms("4.8 retries")
def test_a_process_that_gave_up_is_failed(tmp_path: Path) -> None:
    crash = process("a", "exit=4", required=True, restart=Restart("on-failure", budget=1))
    run = finished(tmp_path, plan(crash, LINGERS))
    assert run.popen.returncode == 4
    assert run.kinds("a").count("process_starting") == 2


def test_what_only_a_trigger_would_start_does_not_keep_the_run(tmp_path: Path) -> None:
    never = process("never", "linger")
    follows = process("follows", "exit=0", depends_on=after("never", "started"))
    triggers = (when_ended("follows", start("never")),)
    run = finished(tmp_path, plan(process("a", "exit=0"), never, follows, triggers=triggers))
    assert run.popen.returncode == 0
    assert run.kinds("never") == ["process_waiting", "process_skipped"]


def test_a_pending_trigger_keeps_the_run(tmp_path: Path) -> None:
    run = finished(tmp_path, plan(triggers=(at_start(log("at last"), delay=0.3),)))
    assert run.popen.returncode == 0
    assert "[orchestra] at last\n" in run.stderr


@pytest.mark.parametrize(
    ("restart", "code", "told"),
    [
        (Restart("on-failure", delay=0.01, max_delay=0.01, growth=1.0, budget=1), 4, "last 2 runs were each"),
        (Restart("always", budget=0), 0, "last run was"),
        (Restart("on-failure", budget=0), 0, ""),
        (Restart("no", budget=0), 4, ""),
    ],
)
def test_it_is_told_why_a_process_is_not_started_again(
    tmp_path: Path, restart: Restart, code: int, told: str
) -> None:
    run = finished(tmp_path, plan(process("a", f"exit={code}", restart=restart)))
    said = [line for line in run.stderr.splitlines() if "not started again" in line]
    assert [f"its {told} shorter than 10 s" in line for line in said] == [True] * bool(told)
