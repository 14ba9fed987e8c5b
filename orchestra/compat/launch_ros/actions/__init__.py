"""What launch files import as `launch_ros.actions`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "ComposableNodeContainer": "composable_node_container",
    "LifecycleNode": "lifecycle_node",
    "LifecycleTransition": "lifecycle_transition",
    "LoadComposableNodes": "load_composable_nodes",
    "Node": "node",
    "PushROSNamespace": "push_ros_namespace",
    "PushRosNamespace": "push_ros_namespace",
    "ROSTimer": "ros_timer",
    "RosTimer": "ros_timer",
    "SetParameter": "set_parameter",
    "SetParametersFromFile": "set_parameters_from_file",
    "SetROSLogDir": "set_ros_log_dir",
    "SetRemap": "set_remap",
    "SetUseSimTime": "set_use_sim_time",
}

__all__ = sorted(_NAMES)  # noqa: PLE0605 - the names are those of the table

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)
