"""`get_default_launch_description`: what older launch services had to include first, nothing by now."""

from __future__ import annotations

from typing import Any

from orchestra.compat.launch.launch_description import LaunchDescription


def get_default_launch_description(
    *,
    prefix_output_with_name: bool = False,
    rclpy_context: Any = None,
) -> LaunchDescription:
    """Return an empty description; the arguments of older releases have no effect."""
    del prefix_output_with_name, rclpy_context
    return LaunchDescription([])
