"""How often a node name has been used in a context."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext

_LOCAL = "unique_ros_node_names"


def add_node_name(context: LaunchContext, node_name: str) -> None:
    """Count a use of a full node name."""
    counts = context.get_locals_as_dict().get(_LOCAL)
    if counts is None:
        counts = defaultdict[str, int](int)
        context.extend_globals({_LOCAL: counts})
    counts[node_name] += 1


def get_node_name_count(context: LaunchContext, node_name: str) -> int:
    """Return how often a full node name has been counted."""
    counts: dict[str, int] = context.get_locals_as_dict().get(_LOCAL, {})
    return counts.get(node_name, 0)
