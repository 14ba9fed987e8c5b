"""What launch files import as `launch_ros`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "actions": "",
    "default_launch_description": "",
    "get_default_launch_description": "default_launch_description",
    "descriptions": "",
    "event_handlers": "",
    "events": "",
    "parameter_descriptions": "",
    "parameters_type": "",
    "remap_rule_type": "",
    "ros_adapters": "",
    "substitutions": "",
    "utilities": "",
}

__all__ = sorted(_NAMES)  # noqa: PLE0605 - the names are those of the table

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)
