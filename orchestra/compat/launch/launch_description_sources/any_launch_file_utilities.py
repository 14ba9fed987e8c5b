"""Launch descriptions of launch files of any kind."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.invalid_launch_file_error import InvalidLaunchFileError
from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.launch.launch_description_sources.any_launch_description_source import (
    AnyLaunchDescriptionSource,
)

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_description import LaunchDescription

__all__ = ["InvalidLaunchFileError", "get_launch_description_from_any_launch_file"]


def get_launch_description_from_any_launch_file(
    launch_file_path: str,
    *,
    parser: Any = None,  # noqa: ARG001 - upstream's signature
) -> LaunchDescription:
    """Return the description of a launch file. Raises `RuntimeError` with what is wrong with it."""
    return AnyLaunchDescriptionSource(launch_file_path).get_launch_description(LaunchContext())
