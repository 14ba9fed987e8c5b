"""What launch files import as `launch_ros.descriptions`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "ComposableLifecycleNode": "composable_lifecycle_node",
    "ComposableNode": "composable_node",
    "Parameter": "orchestra.compat.launch_ros.parameter_descriptions",
    "ParameterFile": "orchestra.compat.launch_ros.parameter_descriptions",
    "ParameterValue": "orchestra.compat.launch_ros.parameter_descriptions",
}

__all__ = sorted(_NAMES)  # noqa: PLE0605 - the names are those of the table

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)
