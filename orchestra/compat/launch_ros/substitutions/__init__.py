"""What launch files import as `launch_ros.substitutions`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "ExecutableInPackage": "executable_in_package",
    "FindPackage": "find_package",
    "FindPackagePrefix": "find_package",
    "FindPackageShare": "find_package",
    "Parameter": "parameter",
}

__all__ = sorted(_NAMES)  # noqa: PLE0605 - the names are those of the table

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)
