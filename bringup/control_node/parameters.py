"""The controller's settings as ROS parameters: declared with descriptors, checked as a whole, taken as a whole."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor, SetParametersResult
from rclpy.node import Node

from bringup.beginning import tell_unknown
from bringup.control.settings import Setting, Settings, objection, table

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rclpy.parameter import Parameter


class UnusableSettingsError(ValueError):
    """The node was started with values that do not go together."""


class Parameters:
    """The settings in force; `changed`, if it is set, is called after each change with the settings before.

    Raises UnusableSettingsError, or rclpy's own errors for a value of the wrong type or out of its range.
    """

    def __init__(self, node: Node) -> None:
        for each in table():
            node.declare_parameter(each.name, each.default, descriptor(each))
        tell_unknown(node, [each.name for each in table()])
        self.settings = Settings(**{each.name: node.get_parameter(each.name).value for each in table()})
        reason = objection(self.settings)
        if reason is not None:
            raise UnusableSettingsError(reason)
        self.changed: Callable[[Settings], None] | None = None
        node.add_on_set_parameters_callback(self._check)
        node.add_post_set_parameters_callback(self._take)

    def _check(self, parameters: Sequence[Parameter]) -> SetParametersResult:
        reason = objection(self._with(parameters))
        return SetParametersResult(successful=reason is None, reason=reason or "")

    def _take(self, parameters: Sequence[Parameter]) -> None:
        before, self.settings = self.settings, self._with(parameters)
        if self.changed is not None:
            self.changed(before)

    def _with(self, parameters: Sequence[Parameter]) -> Settings:
        # rclpy's own parameters, such as use_sim_time, come by here as well.
        ours = {each.name for each in table()}
        return replace(self.settings, **{each.name: each.value for each in parameters if each.name in ours})


def declared(node: Node) -> Parameters:
    """The parameters of a node that is being made. Raises what `Parameters` raises, with the node off the graph."""
    try:
        return Parameters(node)
    except Exception:
        Node.destroy_node(node)  # not what a component does besides: it is not whole yet
        raise


def descriptor(setting: Setting) -> ParameterDescriptor:
    """The parameter's description and range as ROS wants them."""
    described = ParameterDescriptor(
        description=setting.description,
        additional_constraints=setting.constraints,
        read_only=setting.read_only,
    )
    if isinstance(setting.default, bool | str):
        return described
    if isinstance(setting.default, float):
        bounds = FloatingPointRange(from_value=setting.minimum, to_value=setting.maximum, step=0.0)
        described.floating_point_range = [bounds]
    else:
        described.integer_range = [IntegerRange(from_value=setting.minimum, to_value=setting.maximum, step=1)]
    return described
