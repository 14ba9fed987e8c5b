"""The ROS command line in a graph of twenty nodes: how long until the whole answer is there.

An answer that lacks something is an error, no sample. The floor is a process of plain rclpy that looks until it sees
all nodes, of which it is told how many there are; a command is not.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
import time
from contextlib import ExitStack
from typing import TYPE_CHECKING

from benchmarks import launching
from benchmarks.figure import Figure, Sample, Site, UnableError
from benchmarks.signs import Signs
from orchestra.testing.domain import free_domain

if TYPE_CHECKING:
    from collections.abc import Mapping

_SIZES = (5, 10, 20)
_TRIALS = 5
FIGURES = (
    Figure("node-list", "node list in a graph of 20 nodes", "", "value", 0.6, "s", 20, _SIZES, 2, rounds=3),
    Figure("topic-list", "topic list there", "", "value", 0.6, "s", 20, _SIZES, 2, rounds=3),
    Figure("param-get", "param get there", "", "value", 0.6, "s", 20, _SIZES, 2, rounds=3),
    Figure(
        "node-list-floor", "node list there", "plain rclpy that waits for as many nodes",
        "ratio", 1.0, "s", 20, _SIZES, 2, rounds=3,
    ),
)  # fmt: skip

_NODE = """
import os, sys, rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node(sys.argv[1])
node.declare_parameter("number", int(sys.argv[1][1:]))
node.create_publisher(String, sys.argv[1] + "/said", 10)
with open(os.environ["BENCHMARK_SIGNS"], "w") as signs:
    signs.write("up\\n")
try:
    rclpy.spin(node)
except (KeyboardInterrupt, rclpy.executors.ExternalShutdownException):
    pass
"""
_FLOOR = """
import sys, time, rclpy
rclpy.init()
node = rclpy.create_node("_floor")
while len([name for name in node.get_node_names() if not name.startswith("_")]) < int(sys.argv[1]):
    time.sleep(0.005)
print(*node.get_node_names())
"""


def measure(site: Site, size: int) -> Mapping[str, Sample]:
    """Measure it with so many nodes, each in a process."""
    try:
        import rclpy  # noqa: F401, PLC0415 - only whether it is there
    except ImportError:
        raise UnableError("it needs rclpy") from None
    names = [f"n{number}" for number in range(size)]
    with ExitStack() as stack:
        domain = stack.enter_context(free_domain({}))
        signs = stack.enter_context(Signs(site.folder / "signs"))
        variables = launching.with_variables(
            site.environment, ROS_DOMAIN_ID=str(domain), BENCHMARK_SIGNS=signs.path
        )
        there = Site(site.folder, variables)
        nodes = [
            stack.enter_context(launching.started([sys.executable, "-c", _NODE, name], there, may_hang=True))
            for name in names
        ]
        stack.callback(launching.end, [node.pid for node in nodes])
        signs.wait(size)
        listed = [f"/{name}" for name in names]
        topics = sorted([f"/{name}/said" for name in names] + ["/parameter_events", "/rosout"])
        told = {
            "node-list": (launching.orchestra("node", "list"), sorted(listed)),
            "topic-list": (launching.orchestra("topic", "list"), topics),
            "param-get": (
                launching.orchestra("param", "get", listed[-1], "number"),
                [f"Integer value is: {size - 1}"],
            ),
        }
        trials = _TRIALS if size > FIGURES[0].smallest else 1
        samples = {
            name: Sample(_median(trials, command, answer, there)) for name, (command, answer) in told.items()
        }
        floor = _median(trials, [sys.executable, "-c", _FLOOR, str(size)], None, there)
    samples["node-list-floor"] = Sample(samples["node-list"].ours, floor)
    return samples


def _median(trials: int, command: list[str], answer: list[str] | None, site: Site) -> float:
    """Return how long a command takes, over some trials. Raises `RuntimeError` for another answer than this."""
    return statistics.median(_seconds(command, answer, site) for _ in range(trials))


def _seconds(command: list[str], answer: list[str] | None, site: Site) -> float:
    began = time.perf_counter()
    done = subprocess.run(
        command,
        cwd=site.folder,
        env=dict(site.environment),
        check=False,
        capture_output=True,
        text=True,
        timeout=launching.PATIENCE,
    )
    seconds = time.perf_counter() - began
    if done.returncode or (answer is not None and done.stdout.splitlines() != answer):
        raise RuntimeError(f"{command} answered {done.stdout!r} {done.stderr!r}")
    return seconds
