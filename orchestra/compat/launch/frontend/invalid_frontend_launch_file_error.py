"""`InvalidFrontendLaunchFileError`: a file in XML or YAML that is no launch file."""

from __future__ import annotations

from orchestra.compat.launch.invalid_launch_file_error import InvalidLaunchFileError


class InvalidFrontendLaunchFileError(InvalidLaunchFileError):
    """A launch file that cannot be read."""
