"""A package with one Python node, which publishes a message and says so, and launch files that start it."""

from __future__ import annotations

import importlib.util
import sys
from typing import TYPE_CHECKING

from benchmarks.figure import UnableError

if TYPE_CHECKING:
    from pathlib import Path

_TALKER = """\
import os

import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String


def main() -> None:
    rclpy.init()
    node = rclpy.create_node("talker")
    node.create_publisher(String, "~/said", 10).publish(String(data="up"))
    with open(os.environ["BENCHMARK_SIGNS"], "w") as signs:
        signs.write(f"{os.getpid()}\\n")
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == "__main__":
    main()
"""


def write(folder: Path, count: int, more: str = "") -> Path:
    """Write the package and a file that launches so many of its nodes. Raises `UnableError` where there is no rclpy."""
    if importlib.util.find_spec("rclpy") is None:
        raise UnableError("rclpy is not installed")
    nodes = folder / "benchmark_talker" / "nodes"
    nodes.mkdir(parents=True)
    for path in (nodes.parent / "__init__.py", nodes / "__init__.py"):
        path.touch()
    (nodes / "talker.py").write_text(_TALKER)
    file = folder / "nodes.launch.yaml"
    entries = (
        f"  - node: {{pkg: benchmark_talker, exec: talker, name: talker{number}{more}}}\n"
        for number in range(count)
    )
    file.write_text("launch:\n" + "".join(entries))
    return file


def by_hand(number: int) -> list[str]:
    """Return the command that starts one of the nodes by hand."""
    name = f"__node:=talker{number}"
    return [sys.executable, "-m", "benchmark_talker.nodes.talker", "--ros-args", "-r", name]
