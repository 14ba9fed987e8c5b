"""Which action a tag stands for."""

from __future__ import annotations

from types import MappingProxyType
from typing import Any, Final

from orchestra.compat.launch.frontend.classes import class_at

TAGS: Final = MappingProxyType({
    "append_env": "launch:AppendEnvironmentVariable",
    "arg": "launch:DeclareLaunchArgument",
    "executable": "launch:ExecuteProcess",
    "for": "launch:ForLoop",
    "for_each": "launch:ForEach",
    "group": "launch:GroupAction",
    "include": "launch:IncludeLaunchDescription",
    "let": "launch:SetLaunchConfiguration",
    "lifecycle_node": "launch_ros:LifecycleNode",
    "load_composable_node": "launch_ros:LoadComposableNodes",
    "log": "launch:LogInfo",
    "node": "launch_ros:Node",
    "node_container": "launch_ros:ComposableNodeContainer",
    "push_ros_namespace": "launch_ros:PushRosNamespace",
    "reset": "launch:ResetLaunchConfigurations",
    "reset_env": "launch:ResetEnvironment",
    "ros_timer": "launch_ros:RosTimer",
    "set_env": "launch:SetEnvironmentVariable",
    "set_parameter": "launch_ros:SetParameter",
    "set_parameters_from_file": "launch_ros:SetParametersFromFile",
    "set_remap": "launch_ros:SetRemap",
    "set_ros_log_dir": "launch_ros:SetROSLogDir",
    "set_use_sim_time": "launch_ros:SetUseSimTime",
    "shutdown": "launch:Shutdown",
    "timer": "launch:TimerAction",
    "unset_env": "launch:UnsetEnvironmentVariable",
})  # fmt: skip


def class_of_tag(name: str) -> Any:
    """Return the class that a tag of the launch language stands for, None for an unknown one."""
    place = TAGS.get(name.replace("-", "_"))
    return None if place is None else class_at(place, "actions")
