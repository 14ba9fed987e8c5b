"""`matches_node_name`, where it was in older releases."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

from orchestra.compat.launch_ros.events import matchers

if TYPE_CHECKING:
    from orchestra.compat.launch.events.matchers import ActionMatcher


def matches_node_name(node_name: str) -> ActionMatcher:
    """Return what `launch_ros.events.matches_node_name` does, with a warning."""
    message = (
        "launch_ros.events.lifecycle.matches_node_name is deprecated: use launch_ros.events.matches_node_name"
    )
    warnings.warn(message, stacklevel=2)
    return matchers.matches_node_name(node_name)
