"""The monitor's settings as ROS parameters, declared with descriptors."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor

from bringup.beginning import tell_unknown
from bringup.fleet.settings import Setting, Settings, table

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rclpy.node import Node
    from rclpy.parameter import Parameter


class Parameters:
    """The settings in force; `changed` is called after each change.

    rclpy itself refuses values of another type or out of their range, and changes of what only counts at the start.
    """

    def __init__(self, node: Node, changed: Callable[[], None]) -> None:
        for each in table():
            node.declare_parameter(each.name, each.default, _descriptor(each))
        self.settings = Settings(**{each.name: node.get_parameter(each.name).value for each in table()})
        tell_unknown(node, [each.name for each in table()])
        self._changed = changed
        node.add_post_set_parameters_callback(self._take)

    def _take(self, parameters: Sequence[Parameter]) -> None:
        # rclpy's own parameters, such as use_sim_time, come by here as well.
        ours = {each.name for each in table()}
        given = {each.name: each.value for each in parameters if each.name in ours}
        if given:
            self.settings = replace(self.settings, **given)
            self._changed()


def _descriptor(setting: Setting) -> ParameterDescriptor:
    described = ParameterDescriptor(description=setting.description, read_only=setting.fixed)
    if setting.minimum is not None:
        bounds = FloatingPointRange(from_value=setting.minimum, to_value=setting.maximum, step=0.0)
        described.floating_point_range = [bounds]
    return described
