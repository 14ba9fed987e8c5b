"""A command that is held up as it leaves the graph can be ended; its answer is written by then."""

import signal
import subprocess
import sys

import pytest

_COMMAND = """
import os, signal
from orchestra.ros.tools.graph.ending import Ending
with Ending() as ending:
    print("the answer")
    ending.leave()
    os.write(2, b"left" + b"\\n")
    signal.sigwait({signal.SIGUSR1})  # as in code that never comes back to the interpreter
"""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_command_that_is_held_up_as_it_leaves_is_ended_by_a_signal(number: signal.Signals) -> None:
    words = [sys.executable, "-c", _COMMAND]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as command:
        assert command.stdout is not None
        assert command.stderr is not None
        try:
            assert command.stderr.readline() == "left\n"
            command.send_signal(number)
            assert command.wait(30) == -number
            assert command.stdout.read() == "the answer\n"
        finally:
            command.kill()
