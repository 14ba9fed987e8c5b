"""A glance at a command line: whether its run is likely to have nodes in Python, as long as nobody knows.

The fork server takes as long for its imports as the launch files take to be read. So it is started on a guess, which
costs the time of one processor where it is wrong; the plan then says whether it stays. Where a plan is remembered, that
one tells more than the launch file.
"""

from __future__ import annotations

import os
import sys

_OF_NODES = (b"node", b"Node", b"include", b"IncludeLaunchDescription", b"rclpy")
_FILES = (".py", ".yaml", ".yml", ".xml", ".launch")
_LIKELY = (None, "", "rmw_fastrtps_cpp")
_ENOUGH = 1 << 18  # bytes of a launch file
_WARM = b'"warm": {"warm": true'  # of a process in a plan, which stands as it is in what is kept


def nodes_ahead(words: list[str]) -> bool:
    """Tell whether nodes are likely: what a launch file says, for a package's that there is rclpy at all."""
    if "--no-warm" in words or not any(map(_has_rclpy, sys.path)):
        return False
    # rclpy ends its process where that is not installed.
    if os.environ.get("RMW_IMPLEMENTATION") not in _LIKELY:
        return False
    files = [word for word in words[1:] if word.endswith(_FILES) and os.path.isfile(word)]  # noqa: PTH113 - pathlib is slow
    if words[0] == "run":
        return True
    return (not files or any(map(_speaks_of_nodes, files))) and _were_some(words)


def _were_some(words: list[str]) -> bool:
    """Tell whether the plan that is remembered has nodes that are forked; without one that is not known."""
    # The supervisor needs nothing of it where a launch file speaks of no nodes.
    from orchestra.cli.remembered import kept  # noqa: PLC0415

    path = kept(words)
    if path is None:
        return True
    try:
        with open(path, "rb") as file:  # noqa: PTH123 - pathlib is slow
            return _WARM in file.read()
    except OSError:
        return True


def _has_rclpy(folder: str) -> bool:
    return os.path.isdir(f"{folder}/rclpy")  # noqa: PTH112 - pathlib is slow


def _speaks_of_nodes(path: str) -> bool:
    try:
        with open(path, "rb") as file:  # noqa: PTH123 - pathlib is slow
            content = file.read(_ENOUGH)
    except OSError:
        return False
    return any(word in content for word in _OF_NODES)
