"""The parameters of a node by its own account: names, descriptors, values, asked over its parameter services."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from rcl_interfaces.msg import Parameter as ParameterMessage
from rcl_interfaces.msg import ParameterType
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters
from rclpy.parameter import Parameter

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    Ask = Callable[[Any, str, Any], Any]

_TYPES: Final = {
    ParameterType.PARAMETER_BOOL: "bool",
    ParameterType.PARAMETER_INTEGER: "integer",
    ParameterType.PARAMETER_DOUBLE: "double",
    ParameterType.PARAMETER_STRING: "string",
    ParameterType.PARAMETER_BYTE_ARRAY: "byte_array",
    ParameterType.PARAMETER_BOOL_ARRAY: "bool_array",
    ParameterType.PARAMETER_INTEGER_ARRAY: "integer_array",
    ParameterType.PARAMETER_DOUBLE_ARRAY: "double_array",
    ParameterType.PARAMETER_STRING_ARRAY: "string_array",
}


def parameters_of(node: str, ask: Ask) -> list[dict[str, Any]]:
    """Return all parameters of a node, as JSON data: what their descriptors say, and their values."""
    listed = ask(ListParameters, f"{node}/list_parameters", ListParameters.Request())
    names = sorted(listed.result.names)
    described = _one_each(
        names,
        lambda some: ask(DescribeParameters, f"{node}/describe_parameters", _described(some)).descriptors,
    )
    held = _one_each(names, lambda some: ask(GetParameters, f"{node}/get_parameters", _got(some)).values)
    return [
        _parameter(name, descriptor, value)
        for name, descriptor, value in zip(names, described, held, strict=True)
    ]


def _described(names: Sequence[str]) -> DescribeParameters.Request:
    return DescribeParameters.Request(names=names)


def _got(names: Sequence[str]) -> GetParameters.Request:
    return GetParameters.Request(names=names)


def _one_each(names: list[str], ask: Callable[[list[str]], Sequence[Any]]) -> list[Any]:
    """Return an answer for each name, None for none.

    rclcpp answers nothing at all where it cannot answer for one of them, as for the value of one that has none.
    """
    answers = list(ask(names))
    if len(answers) == len(names):
        return answers
    return [next(iter(ask([name])), None) for name in names]


def _parameter(name: str, descriptor: Any, value: Any) -> dict[str, Any]:  # noqa: ANN401 - of an untyped package
    kind = 0 if descriptor is None else descriptor.type
    if not kind and value is not None:
        kind = value.type
    return {
        "name": name,
        "type": _TYPES.get(kind),
        "value": None if value is None else _plain(value),
        "description": getattr(descriptor, "description", ""),
        "additional_constraints": getattr(descriptor, "additional_constraints", ""),
        "read_only": bool(getattr(descriptor, "read_only", False)),
        "dynamic_typing": bool(getattr(descriptor, "dynamic_typing", False)),
        "range": _range(descriptor),
    }


def _plain(value: Any) -> Any:  # noqa: ANN401 - as above, and of any of ROS's types
    """Return the value of a rcl_interfaces/msg/ParameterValue as JSON data."""
    held = Parameter.from_parameter_msg(ParameterMessage(name="it", value=value)).value
    if held is None or isinstance(held, bool | int | float | str):
        return held
    return [item[0] if isinstance(item, bytes) else item for item in held]


def _range(descriptor: Any) -> list[float] | None:  # noqa: ANN401 - as above
    """Return the least and the greatest value, and the step between them."""
    for ranges in (getattr(descriptor, "integer_range", ()), getattr(descriptor, "floating_point_range", ())):
        for one in ranges:
            return [one.from_value, one.to_value, one.step]
    return None
