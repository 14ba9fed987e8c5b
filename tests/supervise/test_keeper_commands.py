"""A launch whose `$(command)` loses the process above it, or is interrupted at that moment."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.keeping import proc
from tests.pressure import Deadline
from tests.supervise.plans import PATIENCE, Launched, assert_ended, wait_for

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

# Everything is gone this many seconds after the command lost its keeper.
BOUND = 6.0
# A child that holds the streams, one in a session of its own, a daemon without streams that is deaf and has no mark.
COMMAND = """\
sleep 1001 &
setsid sleep 1002 &
(env -i setsid sh -c 'trap "" TERM INT HUP; while :; do sleep 1003; done' >/dev/null 2>&1 &)
sleep 1004
"""
SLEEPS = {f"sleep {seconds}" for seconds in range(1001, 1005)}
LAUNCH = """\
launch:
  - executable: {cmd: "echo $(command 'sh begin.sh')", name: greet}
"""


@pytest.fixture
def run(tmp_path: Path) -> Iterator[Launched]:
    """Launch, wait until all of the command runs, and kill at the end what may be left of it."""
    launched = begun(tmp_path)
    known: dict[int, str] = {}

    def all_runs() -> bool:
        known.update((pid, proc.command(pid)) for pid in below(launched))
        return set(known.values()) >= SLEEPS

    try:
        wait_for(all_runs, "all of the command")
        yield launched
    finally:
        for pid, command in known.items():
            if proc.command(pid) == command:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
        launched.popen.wait(PATIENCE)


def begun(folder: Path) -> Launched:
    """Launch the description."""
    (folder / "begin.sh").write_text(COMMAND)
    (folder / "slow.launch.yaml").write_text(LAUNCH)
    home, out, err = folder / "home", folder / "out", folder / "err"
    with out.open("wb") as out_file, err.open("wb") as err_file:
        started = subprocess.Popen(
            [sys.executable, "-m", "orchestra", "launch", "slow.launch.yaml"],
            cwd=folder,
            env={**os.environ, "ORCHESTRA_HOME": str(home), "NO_COLOR": "1"},
            stdin=subprocess.DEVNULL,
            stdout=out_file,
            stderr=err_file,
        )
    return Launched(started, home, out, err)


def below(run: Launched) -> set[int]:
    """Return the launch and everything below it; at this time each process has its parent."""
    return {run.popen.pid, *proc.descendants(run.popen.pid)}


def reapers(run: Launched) -> list[int]:
    """Return the processes that keep a command."""
    return [pid for pid in below(run) if "command_reaper" in proc.command(pid)]


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_a_command_without_its_keeper_fails_the_launch(run: Launched, number: signal.Signals) -> None:
    everything = below(run)
    (reaper,) = reapers(run)
    deadline = Deadline(BOUND)
    os.kill(reaper, number)
    assert run.wait(PATIENCE) == 2
    assert_ended(everything)
    assert not deadline.is_over
    assert "slow.launch.yaml:2:" in run.stderr
    assert "command 'sh' was ended because its keeper, the process above it, was ended" in run.stderr


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
@pytest.mark.parametrize("killed", [False, True], ids=["its keeper stopped", "without its keeper"])
def test_a_stop_ends_the_command(run: Launched, number: signal.Signals, *, killed: bool) -> None:
    """The keeper of the command is stopped, or dead, when the stop signal comes: it does not help any more."""
    everything = below(run)
    (reaper,) = reapers(run)
    deadline = Deadline(BOUND)
    os.kill(reaper, signal.SIGKILL if killed else signal.SIGSTOP)
    run.send(number)
    assert run.wait(PATIENCE) in ({128 + number, 2} if killed else {128 + number})
    assert_ended(everything)
    assert not deadline.is_over
