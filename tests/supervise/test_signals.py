"""What each signal does to a run, sent to a real keeper and to its supervisor; and what programs inherit."""

from __future__ import annotations

import os
import resource
import signal
import sys
import time
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.keeping.signals import received_signals
from orchestra.values import Stop
from tests.supervise.plans import INTERNAL, assert_ended, launched, plan, process, wait_for

if TYPE_CHECKING:
    from pathlib import Path

POLITE = process("polite", "polite", "say=up", "linger")
STUBBORN = process(
    "stubborn", "ignore=INT,TERM", "say=up", "linger", stop=Stop(timeout=1.0, kill_timeout=0.5)
)
STOP = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
FAULTS = (
    signal.SIGABRT,
    signal.SIGBUS,
    signal.SIGFPE,
    signal.SIGILL,
    signal.SIGSEGV,
    signal.SIGSYS,
    signal.SIGTRAP,
)
HARMLESS = (
    *sorted(received_signals() - {*STOP, signal.SIGTSTP, signal.SIGCHLD}),
    signal.SIGCHLD,
    signal.SIGPIPE,
    signal.SIGXFSZ,
)


def test_every_signal_stands_somewhere() -> None:
    """The table in `docs/supervision.md`: what is not harmless stops, suspends, kills, or tells a fault."""
    others = {*STOP, *FAULTS, signal.SIGTSTP, signal.SIGKILL, signal.SIGSTOP}
    assert {*HARMLESS, *others} == signal.valid_signals()
    assert not others & {*HARMLESS}


@pytest.mark.parametrize("target", ["orc-keeper", "orc-supervisor"])
def test_no_other_signal_ends_or_stops_a_run(tmp_path: Path, target: str) -> None:
    with launched(tmp_path, plan(POLITE)) as run:
        run.await_line("polite", "up")
        pid = run.own(target)
        for number in HARMLESS:
            os.kill(pid, number)
        os.kill(run.own("orc-supervisor"), signal.SIGTSTP)
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert run.log("polite") == "up\nbye\n"
        assert [event.data["signal"] for event in run.of_kind("signal_sent")] == ["SIGINT"]


@pytest.mark.parametrize(
    ("target", "number"),
    [*(("orc-keeper", number) for number in FAULTS), ("orc-supervisor", signal.SIGABRT)],
)
def test_a_fault_in_one_of_ours_leaves_nothing(tmp_path: Path, target: str, number: signal.Signals) -> None:
    with launched(tmp_path, plan(POLITE), preexec_fn=without_core) as run:
        run.await_line("polite", "up")
        before = run.everything()
        os.kill(run.own(target), number)
        assert run.wait() == (-number if target == "orc-keeper" else 1)
        run.assert_gone()
        assert_ended(before)


def without_core() -> None:
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_to_repeat_a_graceful_stop_changes_nothing(tmp_path: Path, number: signal.Signals) -> None:
    """A service manager, timeout(1) and a shell whose terminal closes send it to us twice."""
    with launched(tmp_path, plan(STUBBORN)) as run:
        run.await_line("stubborn", "up")
        begin = time.monotonic()
        for count in range(4):
            run.send(number)
            os.kill(run.own("orc-supervisor"), number)
            wait_for(lambda: run.of_kind("run_stopping"), f"the stop, {count}")
        assert run.wait() == 128 + number
        assert time.monotonic() - begin > 1.5
        assert [event.data["signal"] for event in run.of_kind("signal_sent")] == [
            "SIGINT",
            "SIGTERM",
            "SIGKILL",
        ]


def test_a_stopped_keeper_goes_on_where_it_was(tmp_path: Path) -> None:
    with launched(tmp_path, plan(POLITE)) as run:
        run.await_line("polite", "up")
        run.send(signal.SIGSTOP)
        run.send(signal.SIGTERM)
        os.kill(run.own("orc-supervisor"), signal.SIGINT)
        run.await_event("run_ended")
        run.send(signal.SIGCONT)
        assert run.wait() == 130


INHERITED = """
import os, resource, signal
status = dict(line.split(":", 1) for line in open("/proc/self/status"))
for name in ("SigBlk", "SigIgn", "SigCgt", "Umask"):
    print(name, status[name].strip())
print("files", *sorted(os.listdir("/proc/self/fd"), key=int)[:-1])
print("terminal", os.ctermid() and open("/proc/self/stat").read().rpartition(")")[2].split()[4])
print("session", os.getsid(0) == os.getpid() == os.getpgrp())
print("nofile", *resource.getrlimit(resource.RLIMIT_NOFILE))
print("core", *resource.getrlimit(resource.RLIMIT_CORE))
print("oom", open("/proc/self/oom_score_adj").read().strip())
print("nice", os.nice(0))
"""


def unusual() -> None:
    """Begin as a careless caller lets a program begin."""
    for number in (
        signal.SIGUSR1,
        signal.SIGPIPE,
        signal.SIGXFSZ,
        signal.SIGCHLD,
        signal.SIGHUP,
        signal.SIGTSTP,
    ):
        signal.signal(number, signal.SIG_IGN)
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM, signal.SIGUSR2, signal.SIGCHLD})
    os.umask(0o027)
    os.nice(3)
    resource.setrlimit(resource.RLIMIT_NOFILE, (333, 444))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with open("/proc/self/oom_score_adj", "w") as file:  # noqa: PTH123
        file.write("321")


@pytest.mark.parametrize("tty", [False, True])
def test_a_program_begins_with_a_clean_slate_and_the_limits_of_the_caller(
    tmp_path: Path, *, tty: bool
) -> None:
    """No signal is ignored or blocked, no descriptor is open but three; what the caller limits is as it was."""
    command = (sys.executable, "-S", "-E", "-c", INHERITED)
    program = process("a", command=command, emulate_tty=tty, success_exit_codes=None)
    readable, writable = os.pipe()
    os.set_inheritable(writable, True)
    with launched(tmp_path, plan(program), preexec_fn=unusual, pass_fds=(writable,)) as run:
        assert run.wait() == 0
    os.close(readable)
    os.close(writable)
    told = dict(line.split(" ", 1) for line in run.log("a").splitlines())
    # An interpreter ignores SIGPIPE and SIGXFSZ and handles SIGINT itself.
    own = (1 << signal.SIGPIPE - 1) | (1 << signal.SIGXFSZ - 1)
    assert int(told.pop("SigIgn"), 16) & ~INTERNAL == own
    assert int(told.pop("SigCgt"), 16) == 1 << signal.SIGINT - 1
    assert told == {
        "SigBlk": "0" * 16,
        "Umask": "0027",
        "files": "0 1 2",
        "terminal": "0",
        "session": "True",
        "nofile": "333 444",
        "core": "0 0",
        "oom": "321",
        "nice": str(min(os.nice(0) + 3, 19)),
    }


def test_what_an_interpreter_ignores_itself_is_not_ignored_in_programs(tmp_path: Path) -> None:
    shell = "grep -E 'Sig(Blk|Ign)' /proc/self/status"
    with launched(tmp_path, plan(process("a", command=("/bin/sh", "-c", shell)))) as run:
        assert run.wait() == 0
    found = {int(line.split()[1], 16) & ~INTERNAL for line in run.log("a").splitlines()}
    assert found == {0}
