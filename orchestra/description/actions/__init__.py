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
    "arg": "arg:Arg",
    "executable": "executable:Executable",
    "group": "group:Group",
    "include": "include:Include",
    "let": "let:Let",
    "log": "log:Log",
    "node": "node:Node",
    "push_ros_namespace": "push_ros_namespace:PushRosNamespace",
    "set_env": "set_env:SetEnv",
    "set_parameter": "set_parameter:SetParameter",
    "set_remap": "set_remap:SetRemap",
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
