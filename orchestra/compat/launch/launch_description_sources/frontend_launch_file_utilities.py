"""Launch descriptions of launch files in XML and YAML."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.frontend.invalid_frontend_launch_file_error import InvalidFrontendLaunchFileError
from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.launch.launch_description_sources.frontend_launch_description_source import (
    FrontendLaunchDescriptionSource,
)

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_description import LaunchDescription

__all__ = ["InvalidFrontendLaunchFileError", "get_launch_description_from_frontend_launch_file"]


def get_launch_description_from_frontend_launch_file(
    frontend_launch_file_path: str,
    *,
    parser: Any = None,  # noqa: ARG001 - upstream's signature
) -> LaunchDescription:
    """Return the description of a launch file. Raises `RuntimeError` with what is wrong with it."""
    source = FrontendLaunchDescriptionSource(frontend_launch_file_path)
    return source.get_launch_description(LaunchContext())
