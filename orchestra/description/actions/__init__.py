"""One model per action, and the table from the name a user writes to the model.

The models are imported when a file first uses them.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from orchestra.description.entity import Action

ACTIONS: dict[str, str] = {
    "append_env": "append_env:AppendEnv",
    "arg": "arg:Arg",
    "executable": "executable:Executable",
    "for": "for_loop:ForLoop",
    "for_each": "for_loop:ForEachLoop",
    "group": "group:Group",
    "include": "include:Include",
    "let": "let:Let",
    "lifecycle_node": "lifecycle_node:LifecycleNode",
    "load_composable_node": "load_composable_node:LoadComposableNode",
    "log": "log:Log",
    "node": "node:Node",
    "node_container": "node_container:NodeContainer",
    "push_ros_namespace": "push_ros_namespace:PushRosNamespace",
    "reset": "reset:Reset",
    "reset_env": "reset_env:ResetEnv",
    "ros_timer": "ros_timer:RosTimer",
    "set_env": "set_env:SetEnv",
    "set_parameter": "set_parameter:SetParameter",
    "set_parameters_from_file": "set_parameters_from_file:SetParametersFromFile",
    "set_remap": "set_remap:SetRemap",
    "set_ros_log_dir": "set_ros_log_dir:SetRosLogDir",
    "set_use_sim_time": "set_use_sim_time:SetUseSimTime",
    "shutdown": "shutdown:Shutdown",
    "timer": "timer:Timer",
    "unset_env": "unset_env:UnsetEnv",
}


@cache
def model_of(name: str) -> type[Action] | None:
    """Return the model of an action, None for an unknown name."""
    place = ACTIONS.get(name)
    if place is None:
        return None
    module, _, attribute = place.partition(":")
    model: type[Action] = getattr(import_module(f"{__name__}.{module}"), attribute)
    return model
