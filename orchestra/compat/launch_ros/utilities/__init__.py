"""What launch files import as `launch_ros.utilities`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "add_node_name": "track_node_names",
    "evaluate_parameter_dict": "evaluate_parameters",
    "evaluate_parameters": "evaluate_parameters",
    "evaluate_parameters_dict": "evaluate_parameters",
    "get_node_name_count": "track_node_names",
    "is_namespace_absolute": "namespace_utils",
    "is_root_namespace": "namespace_utils",
    "make_namespace_absolute": "namespace_utils",
    "normalize_parameter_dict": "normalize_parameters",
    "normalize_parameters": "normalize_parameters",
    "normalize_parameters_dict": "normalize_parameters",
    "normalize_remap_rule": "normalize_remap_rule",
    "normalize_remap_rules": "normalize_remap_rule",
    "prefix_namespace": "namespace_utils",
    "to_parameters_list": "to_parameters_list",
}

__all__ = sorted(_NAMES)  # noqa: PLE0605 - the names are those of the table

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)
