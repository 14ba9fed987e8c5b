"""The arbiter's sources as ROS parameters: whatever names were given below `topics` and `locks`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor, SetParametersResult

from bringup.arbiter.settings import ENTRIES, GROUPS, Entry, SettingsError, names, settings, unknown
from bringup.control_node.parameters import UnusableSettingsError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rclpy.node import Node
    from rclpy.parameter import Parameter

    from bringup.arbiter.settings import Settings

STAMPED = "use_stamped"


class Parameters:
    """The sources in force, and whether velocities are stamped.

    Raises UnusableSettingsError, or rclpy's own errors for a value of the wrong type or out of its range.
    """

    def __init__(self, node: Node) -> None:
        given = {name: each.value for name, each in node._parameter_overrides.items()}  # noqa: SLF001 - nowhere else
        described = ParameterDescriptor(
            description="Whether velocities come and go as TwistStamped instead of Twist", read_only=True
        )
        self.use_stamped: bool = node.declare_parameter(STAMPED, False, described).value
        _tell_unknown(node, given)
        self._values = {name: value for group in GROUPS for name, value in _declared(node, group, given)}
        try:
            self.settings: Settings = settings(self._values)
        except SettingsError as error:
            raise UnusableSettingsError(str(error)) from error
        node.add_on_set_parameters_callback(self._check)
        node.add_post_set_parameters_callback(self._take)

    def _check(self, parameters: Sequence[Parameter]) -> SetParametersResult:
        try:
            settings(self._with(parameters))
        except SettingsError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _take(self, parameters: Sequence[Parameter]) -> None:
        self._values = self._with(parameters)
        self.settings = settings(self._values)

    def _with(self, parameters: Sequence[Parameter]) -> dict[str, Any]:
        return self._values | {each.name: each.value for each in parameters if each.name in self._values}


def _declared(node: Node, group: str, given: dict[str, Any]) -> list[tuple[str, Any]]:
    found = []
    for source in names(group, given):
        for entry in ENTRIES:
            name = f"{group}.{source}.{entry.name}"
            value = given.get(name)
            if value is None:
                continue
            if entry.kind is float and type(value) is int:  # `timeout: 1` means 1.0
                value = float(value)
            described = descriptor(entry, GROUPS[group].format(name=source))
            node.declare_parameter(name, value, described, ignore_override=True)
            found.append((name, value))
    return found


def _tell_unknown(node: Node, given: dict[str, Any]) -> None:
    rest = [each for each in given if not (node.has_parameter(each) or each.startswith("qos_overrides."))]
    for name, near in sorted(unknown(rest).items()):
        hint = f"; did you mean {near}?" if near else ""
        node.get_logger().warning(f"parameter {name} is unknown and has no effect{hint}")


def descriptor(entry: Entry, what: str) -> ParameterDescriptor:
    """The parameter's description and range as ROS wants them."""
    described = ParameterDescriptor(
        description=entry.description.format(what=what), read_only=entry.read_only
    )
    if entry.minimum is None or entry.maximum is None:
        return described
    if entry.kind is float:
        bounds = FloatingPointRange(from_value=entry.minimum, to_value=entry.maximum, step=0.0)
        described.floating_point_range = [bounds]
    else:
        whole = IntegerRange(from_value=int(entry.minimum), to_value=int(entry.maximum), step=1)
        described.integer_range = [whole]
    return described
