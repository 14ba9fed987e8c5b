"""What launch files import as `launch.launch_description_sources`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "AnyLaunchDescriptionSource": "any_launch_description_source",
    "FrontendLaunchDescriptionSource": "frontend_launch_description_source",
    "InvalidFrontendLaunchFileError": "frontend_launch_file_utilities",
    "InvalidLaunchFileError": "any_launch_file_utilities",
    "InvalidPythonLaunchFileError": "python_launch_file_utilities",
    "PythonLaunchDescriptionSource": "python_launch_description_source",
    "get_launch_description_from_any_launch_file": "any_launch_file_utilities",
    "get_launch_description_from_frontend_launch_file": "frontend_launch_file_utilities",
    "get_launch_description_from_python_launch_file": "python_launch_file_utilities",
    "load_python_launch_file_as_module": "python_launch_file_utilities",
}

__all__ = sorted(_NAMES)  # noqa: PLE0605 - the names are those of the table

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)
