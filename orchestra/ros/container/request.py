"""From a request to load a component to what the component is given (`ComponentManager::create_node_options`)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from rclpy.parameter import Parameter

from orchestra.ros.container.given import Given
from orchestra.ros.container.refusal import RefusalError

if TYPE_CHECKING:
    from collections.abc import Iterator

# What rclcpp_components knows of extra arguments; it takes no notice of others.
_INTRA_PROCESS: Final = "use_intra_process_comms"  # rclpy has nothing like it
_OF_ALL: Final = "forward_global_arguments"


def given_by(request: Any) -> Given:  # noqa: ANN401 - of an untyped package
    """Return what a request gives to its component. Raises `RefusalError`."""
    extra = {item.name: item for item in request.extra_arguments}
    _flag(extra, _INTRA_PROCESS)
    rules = (rule for rule in _rules(request))
    words = [word for rule in rules for word in ("-r", rule)]
    return Given(
        ["--ros-args", *words] if words else [],
        list(map(_parameter, request.parameters)),
        of_all=_flag(extra, _OF_ALL),
    )


def _rules(request: Any) -> Iterator[str]:  # noqa: ANN401 - as above
    yield from request.remap_rules
    if request.node_name:
        yield f"__node:={request.node_name}"
    if request.node_namespace:
        yield f"__ns:={request.node_namespace}"


def _flag(extra: dict[str, Any], name: str) -> bool:
    if name not in extra:
        return False
    value = Parameter.from_parameter_msg(extra[name])
    if value.type_ is not Parameter.Type.BOOL:
        raise RefusalError(f"Extra component argument '{name}' must be a boolean")
    return bool(value.value)


def _parameter(message: Any) -> Parameter:  # noqa: ANN401 - as above
    try:
        return Parameter.from_parameter_msg(message)
    except (TypeError, ValueError) as error:
        raise RefusalError(f"the value of parameter '{message.name}' is none: {error}") from error
