"""A command that is held up as it leaves the graph can be ended; its answer is written by then."""

import signal
import subprocess
import sys

import pytest

from orchestra.ros.tools.graph.ending import Ending

_COMMAND = """
import os, signal
from orchestra.ros.tools.graph import ending as module
from orchestra.ros.tools.graph.ending import Ending
module._LONGEST = {longest}
with Ending() as ending:
    print("the answer")
    ending.leave()
    os.write(2, b"left" + b"\\n")
    signal.sigwait({{signal.SIGUSR1}})  # as in code that never comes back to the interpreter
"""


def _command(longest: float) -> subprocess.Popen[str]:
    words = [sys.executable, "-c", _COMMAND.format(longest=longest)]
    return subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_command_that_is_held_up_as_it_leaves_is_ended_by_a_signal(number: signal.Signals) -> None:
    with _command(longest=1000.0) as command:
        assert command.stdout is not None
        assert command.stderr is not None
        try:
            assert command.stderr.readline() == "left\n"
            command.send_signal(number)
            assert command.wait(30) == -number
            assert command.stdout.read() == "the answer\n"
        finally:
            command.kill()


def test_a_command_that_is_held_up_as_it_leaves_ends_by_itself() -> None:
    with _command(longest=0.01) as command:
        out, _ = command.communicate(timeout=60)
    assert (command.returncode, out) == (-signal.SIGALRM, "the answer\n")


def test_what_alarms_there_were_go_on_when_it_has_left() -> None:
    rung: list[int] = []
    before = signal.signal(signal.SIGALRM, lambda number, _: rung.append(number))
    timer = signal.setitimer(signal.ITIMER_REAL, 1000.0)
    try:
        with Ending() as ending:
            ending.leave()
            assert signal.getsignal(signal.SIGALRM) == signal.SIG_DFL
        remaining, _ = signal.getitimer(signal.ITIMER_REAL)
        assert 900.0 < remaining <= 1000.0
        signal.raise_signal(signal.SIGALRM)
    finally:
        signal.signal(signal.SIGALRM, before)
        signal.setitimer(signal.ITIMER_REAL, *timer)
    assert rung == [signal.SIGALRM]
