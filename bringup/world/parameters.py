"""The table of settings as ROS parameters, with descriptors and ranges."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.parameter import Parameter

from bringup.world.settings import TABLE, Setting, Settings, settings

if TYPE_CHECKING:
    from rclpy.node import Node


def declare(node: Node) -> Settings:
    """Declare all parameters and read them.

    Raises rclpy's InvalidParameterTypeException and InvalidParameterValueException for a wrong type and a value out
    of range, SettingsError for values that do not go together.
    """
    return settings({setting.name: _declare(node, setting) for setting in TABLE})


def _declare(node: Node, setting: Setting) -> Any:  # noqa: ANN401 - a parameter's value
    descriptor = _descriptor(setting)
    if setting.default == () or isinstance(setting.default, float):
        given = _floats(_given(node, setting.name))
        if given is not None:
            return node.declare_parameter(setting.name, given, descriptor, ignore_override=True).value
    if setting.default == ():
        # Without a value the parameter has a type all the same; an empty list would be taken for bytes.
        return node.declare_parameter(setting.name, Parameter.Type.DOUBLE_ARRAY, descriptor).value or ()
    default = list(setting.default) if isinstance(setting.default, tuple) else setting.default
    return node.declare_parameter(setting.name, default, descriptor).value


def _given(node: Node, name: str) -> Any:  # noqa: ANN401 - a parameter's value
    """What the command line or a parameter file says about a parameter, of whatever type; None for nothing."""
    anything = ParameterDescriptor(dynamic_typing=True)
    value = node.declare_parameter(name, None, anything).value
    node.undeclare_parameter(name)
    return value


def _floats(value: Any) -> float | list[float] | None:  # noqa: ANN401 - a parameter's value
    """Whole numbers as numbers, since `duration:=10` means 10.0; None for what is no number or an empty list."""
    if isinstance(value, bool | str | bytes | None):
        return None
    if isinstance(value, int | float):
        return float(value)
    numbers = [number for item in value if isinstance(number := _floats(item), float)]
    return numbers if numbers and len(numbers) == len(value) else None


def _descriptor(setting: Setting) -> ParameterDescriptor:
    descriptor = ParameterDescriptor(
        description=setting.description,
        additional_constraints=setting.constraints,
        read_only=not setting.changeable,
    )
    if isinstance(setting.default, float):
        descriptor.floating_point_range = [FloatingPointRange(from_value=setting.low, to_value=setting.high)]
    elif isinstance(setting.default, int) and not isinstance(setting.default, bool):
        descriptor.integer_range = [IntegerRange(from_value=int(setting.low), to_value=int(setting.high))]
    return descriptor
