"""What each action takes from its entity: the keywords of its constructor.

`Action.parse` looks here, so that a third party's class that derives from one of ours has its attributes too.
"""

from __future__ import annotations

from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.launch.frontend.reading.attributes import condition

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.compat.launch.frontend.entity import Entity

_READERS: Final = MappingProxyType({
    "AppendEnvironmentVariable": "variables:append_environment_variable",
    "ComposableNodeContainer": "nodes:container",
    "DeclareLaunchArgument": "variables:declaration",
    "ExecuteLocal": "processes:execute_local",
    "ExecuteProcess": "processes:execute_process",
    "ForEach": "loops:for_each",
    "ForLoop": "loops:for_loop",
    "GroupAction": "structure:group",
    "IncludeLaunchDescription": "structure:include",
    "LifecycleNode": "nodes:lifecycle_node",
    "LoadComposableNodes": "nodes:load_composable_nodes",
    "LogInfo": "structure:log",
    "Node": "nodes:node",
    "PushROSNamespace": "scopes:push_namespace",
    "ROSTimer": "structure:timer",
    "ResetLaunchConfigurations": "variables:reset_configurations",
    "SetEnvironmentVariable": "variables:assignment",
    "SetLaunchConfiguration": "variables:assignment",
    "SetParameter": "scopes:set_parameter",
    "SetParametersFromFile": "scopes:set_parameters_from_file",
    "SetROSLogDir": "scopes:set_log_dir",
    "SetRemap": "scopes:set_remap",
    "SetUseSimTime": "scopes:set_use_sim_time",
    "Shutdown": "structure:shutdown",
    "TimerAction": "structure:timer",
    "UnsetEnvironmentVariable": "variables:removal",
    "UnsetLaunchConfiguration": "variables:removal",
})  # fmt: skip


def keywords(
    kind: type[Any],
    entity: Entity,
    parser: Any,
    ignored: Iterable[str],
) -> dict[str, Any]:
    """Return the keywords with which an entity constructs an action of a class, attributes in `ignored` left out.

    Raises `AttributeError`, `TypeError`, `ValueError` or `RuntimeError` as upstream.
    """
    found = condition(entity, parser)
    reader = next(
        (_READERS[base.__name__] for base in kind.__mro__ if _is_ours(base) and base.__name__ in _READERS),
        None,
    )
    if reader is not None:
        module, _, function = reader.partition(":")
        read = getattr(import_module(f"{__name__}.{module}"), function)
        found.update(read(entity, parser, frozenset(ignored)))
    return found


def _is_ours(kind: type[Any]) -> bool:
    return kind.__module__.startswith("orchestra.compat.")
