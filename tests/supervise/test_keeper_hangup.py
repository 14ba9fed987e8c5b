"""Runs that are to go on when their terminal is closed, as nohup(1) says it: with SIGHUP ignored at the start."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import pytest

from tests.supervise.plans import launched, name_of, plan, process, wait_for
from tests.supervise.test_terminal import in_terminal

POLITE = process("polite", "polite", "say=up", "linger")
# It talks on as long as it runs, so that output meets the terminal that is no longer there.
CLOCK = process("clock", command=("/bin/sh", "-c", "while :; do echo tick; sleep 0.1; done"))
NOHUP = ("/bin/sh", "-c", 'trap "" HUP; exec "$@"', "sh")
BACKGROUND = ("/bin/sh", "-c", 'trap "" INT; exec "$@"', "sh")


def ignores(pid: int, number: int) -> bool:
    """Tell whether a process ignores a signal (proc(5), SigIgn)."""
    lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    mask = next(line.split()[1] for line in lines if line.startswith("SigIgn:"))
    return bool(int(mask, 16) >> (number - 1) & 1)


def ticks(path: Path) -> int:
    """Count the lines of the clock."""
    return path.read_text().count("tick\n")


def test_a_run_goes_on_without_its_terminal(tmp_path: Path) -> None:
    with in_terminal(tmp_path, POLITE, CLOCK, through=NOHUP) as (run, terminal):
        run.await_line("polite", "up")
        run.await_line("clock", "tick")
        os.close(terminal.ours)
        log = run.directory / "logs" / "clock.log"
        seen = ticks(log)
        wait_for(lambda: ticks(log) > seen + 10, "output after the end of the terminal")
        assert run.popen.poll() is None
        run.send(signal.SIGHUP)
        os.kill(run.own("orc-supervisor"), signal.SIGHUP)
        wait_for(lambda: ticks(log) > seen + 20, "output after a hang-up for keeper and supervisor")
        run.send(signal.SIGTERM)
        assert run.wait() == 143
        run.assert_gone()
        assert run.log("polite") == "up\nbye\n"


def test_only_what_is_ours_disregards_the_hang_up(tmp_path: Path) -> None:
    with launched(tmp_path, plan(CLOCK), through=NOHUP) as run:
        run.await_line("clock", "tick")
        (shell,) = (pid for pid in run.everything() if name_of(pid) == "sh")
        assert ignores(run.popen.pid, signal.SIGHUP)
        assert not ignores(run.popen.pid, signal.SIGINT)
        assert not ignores(shell, signal.SIGHUP)
        os.kill(shell, signal.SIGHUP)
        assert run.await_event("process_ended", "clock").data["signal"] == signal.SIGHUP


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGHUP])
def test_a_job_in_the_background_hears_every_stop_signal(tmp_path: Path, number: signal.Signals) -> None:
    with launched(tmp_path, plan(POLITE), through=BACKGROUND) as run:
        run.await_line("polite", "up")
        run.send(number)
        assert run.wait() == 128 + number
        assert run.log("polite") == "up\nbye\n"


def test_a_resolver_ignores_it_too(tmp_path: Path) -> None:
    with launched(tmp_path, ("wait",), through=NOHUP) as run:
        wait_for(lambda: "resolving" in run.stderr, "the resolver")
        assert ignores(run.own("orc-resolver"), signal.SIGHUP)
        run.send(signal.SIGTERM)
        assert run.wait() == 143
