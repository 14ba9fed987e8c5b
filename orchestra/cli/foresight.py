"""A glance at a command line: whether its run is likely to have nodes in Python, as long as nobody knows.

The fork server takes as long for its imports as the launch files take to be read. So it is started on a guess, which
costs the time of one processor where it is wrong; the plan then says whether it stays.
"""

from __future__ import annotations

import os
import re
import sys

_OF_NODES = re.compile(rb"\b(?:\w*node\w*|\w*Node\w*|include|IncludeLaunchDescription|rclpy)\b")
_FILES = (".py", ".yaml", ".yml", ".xml", ".launch")
_ENOUGH = 1 << 18  # bytes of a launch file


def nodes_ahead(words: list[str]) -> bool:
    """Tell whether nodes are likely: what a launch file says, for a package's that there is rclpy at all."""
    if "--no-warm" in words or not any(map(_has_rclpy, sys.path)):
        return False
    files = [word for word in words[1:] if word.endswith(_FILES) and os.path.isfile(word)]  # noqa: PTH113 - pathlib is slow
    return words[0] == "run" or not files or any(map(_speaks_of_nodes, files))


def _has_rclpy(folder: str) -> bool:
    return os.path.isdir(f"{folder}/rclpy")  # noqa: PTH112 - pathlib is slow


def _speaks_of_nodes(path: str) -> bool:
    try:
        with open(path, "rb") as file:  # noqa: PTH123 - pathlib is slow
            return _OF_NODES.search(file.read(_ENOUGH)) is not None
    except OSError:
        return False
