"""What a container is asked when a component is loaded, for user code that wants to know it."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch_ros.node_words import global_parameters, rules
from orchestra.compat.launch_ros.utilities.evaluate_parameters import evaluate_parameters
from orchestra.compat.launch_ros.utilities.namespace_utils import make_namespace_absolute, prefix_namespace
from orchestra.compat.launch_ros.utilities.to_parameters_list import to_parameters_list
from orchestra.dataclass import dataclass
from orchestra.fields import field

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.launch_ros.descriptions.composable_node import ComposableNode


@dataclass(slots=True)
class Request:
    """The fields of `composition_interfaces/srv/LoadNode`, for where that package is not installed."""

    package_name: str = ""
    plugin_name: str = ""
    node_name: str = ""
    node_namespace: str = ""
    log_level: int = 0
    remap_rules: list[str] = field(default_factory=list)
    parameters: list[Any] = field(default_factory=list)
    extra_arguments: list[Any] = field(default_factory=list)


def load_request(component: ComposableNode, context: LaunchContext) -> Any:
    """Return the request for a component in the present scope, None where its condition is false.

    Raises `ImportError` for one with parameters where there is no rclpy.
    """
    condition = component.condition()
    if condition is not None and not condition.evaluate(context):
        return None
    request = _empty()
    request.package_name = _performed(component.package, context)
    request.plugin_name = _performed(component.node_plugin, context)
    if component.node_name is not None:
        request.node_name = _performed(component.node_name, context)
    own = None if component.node_namespace is None else _performed(component.node_namespace, context)
    base = context.launch_configurations.get("ros_namespace", None)
    namespace = make_namespace_absolute(prefix_namespace(base, own))
    request.node_namespace = namespace or ""
    request.remap_rules = [f"{left}:={right}" for left, right in rules(component.remappings or (), context)]
    parameters = [*global_parameters(context), *(component.parameters or ())]
    request.parameters = _messages(parameters, request, namespace, context)
    request.extra_arguments = _messages(component.extra_arguments or (), request, namespace, context)
    return request


def _empty() -> Any:
    try:
        return import_module("composition_interfaces.srv").LoadNode.Request()
    except ImportError:
        return Request()


def _messages(parameters: Any, request: Any, namespace: str | None, context: LaunchContext) -> list[Any]:
    """Return parameters as messages of rcl_interfaces."""
    if not parameters:
        return []
    evaluated = evaluate_parameters(context, parameters)
    found = to_parameters_list(context, request.node_name, namespace or "", evaluated)
    return [parameter.to_parameter_msg() for parameter in found]


def _performed(subs: Iterable[Substitution], context: LaunchContext) -> str:
    return "".join(context.perform_substitution(sub) for sub in subs)
