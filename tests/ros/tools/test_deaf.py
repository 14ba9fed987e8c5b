"""Those who cannot answer are not waited for."""

from __future__ import annotations

import signal
import subprocess
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING

import pytest

from orchestra.ros.tools.graph.deaf import is_stopped
from tests.killing import kill
from tests.supervise.plans import wait_for

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tests.ros.tools.conftest import Graph

# The ports of a participant that never hears anything.
_DEAF = """
import signal, socket, sys
held = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2)]
for one, port in zip(held, map(int, sys.argv[1:])):
    one.bind(("127.0.0.1", port))
print("ready", flush=True)
signal.pause()
"""
_NODES = "/robot1/actor\n/robot1/machine\n"
# Who waits for them does so for longer than a test may take.
_WAITING = ("--spin-time", "600")


@contextmanager
def _deaf(graph: Graph, **variables: str) -> Iterator[subprocess.Popen[str]]:
    first = 7400 + 250 * int(graph.environment["ROS_DOMAIN_ID"]) + 10 + 2 * 90
    with subprocess.Popen(
        [sys.executable, "-c", _DEAF, str(first), str(first + 1)],
        env={**graph.environment, **variables},
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        try:
            assert process.stdout is not None
            assert process.stdout.readline() == "ready\n"
            yield process
        finally:
            kill(process)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("node", "list"), _NODES),
        (("topic", "echo", "/robot1/map", "--once"), "data: a map\n---\n"),  # by a node
    ],
)
def test_who_is_stopped_is_told_of_at_once(graph: Graph, words: tuple[str, ...], told: str) -> None:
    with _deaf(graph) as process:
        process.send_signal(signal.SIGSTOP)
        wait_for(lambda: is_stopped(process.pid), "the process to be stopped")
        done = graph.ask(*words, *_WAITING)
    assert (done.status, done.output) == (0, told)
    assert (
        done.errors == f"warning: what is stopped has not answered, and is missing: process {process.pid}\n"
    )


def test_who_has_discovery_off_is_not_missed(graph: Graph) -> None:
    with _deaf(graph, ROS_AUTOMATIC_DISCOVERY_RANGE="OFF"):
        done = graph.ask("node", "list", *_WAITING)
    assert done == (0, _NODES, "")
