"""`launch_ros.ros_adapters`: launch files are understood in a process that takes no part in ROS."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext

_INSTEAD = (
    "there is no ROS node while a launch file is resolved: wait for topics and nodes with `ready` and `depends_on`, "
    "change states with lifecycle events, and start a node of your own for everything else"
)


class ROSAdapter:
    """Upstream's node beside the launch. Raises `RuntimeError` that says what to use instead."""

    def __init__(self, *, argv: Any = None, autostart: bool = True) -> None:
        del argv, autostart
        raise RuntimeError(_INSTEAD)


def get_ros_adapter(context: LaunchContext) -> NoReturn:
    """Raise `RuntimeError` that says what to use instead."""
    del context
    raise RuntimeError(_INSTEAD)


def get_ros_node(context: LaunchContext) -> NoReturn:
    """Raise `RuntimeError` that says what to use instead."""
    del context
    raise RuntimeError(_INSTEAD)
