"""A node that has been told to end does, even where what it gives back does not come back."""

import signal
import subprocess
import sys

_NODE = """
import select, signal
from bringup.ending import ENDING, leave
signal.pthread_sigmask(signal.SIG_BLOCK, ENDING)
if {handled}:
    signal.signal(signal.SIGTERM, lambda *_: None)

class Held:
    def destroy_node(self):
        print("held", flush=True)
        signal.sigwait({{signal.SIGUSR1}})  # as in code that never comes back to the interpreter

leave(Held())
"""


def _ended_by(number: signal.Signals, *, handled: bool) -> int:
    with subprocess.Popen(
        [sys.executable, "-c", _NODE.format(handled=handled)], stdout=subprocess.PIPE, text=True
    ) as node:
        assert node.stdout is not None
        try:
            assert node.stdout.readline() == "held\n"
            node.send_signal(number)
            return node.wait(30)
        finally:
            node.kill()


def test_a_node_that_is_held_up_as_it_leaves_is_ended_by_sigterm() -> None:
    assert _ended_by(signal.SIGTERM, handled=False) == -signal.SIGTERM


def test_a_handler_that_it_had_no_longer_holds_it() -> None:
    assert _ended_by(signal.SIGTERM, handled=True) == -signal.SIGTERM
