"""The node's parameters: read once at the start, shown with their defaults, refused to change afterwards."""

from collections.abc import Sequence

from rcl_interfaces.msg import SetParametersResult
from rclpy.exceptions import InvalidTopicNameException
from rclpy.node import Node
from rclpy.parameter import Parameter

from bringup.filter.parameter_reader import ParameterError
from bringup.filter.parameters import read_settings
from bringup.filter.settings import Sensor, Settings

# Parameters of every rclpy node; the filter only looks at `use_sim_time` among them.
_OF_RCLPY = ("qos_overrides.", "start_type_description_service")


def configure(node: Node) -> Settings:
    """Read the filter's settings from the parameters of a node.

    The node must have been made with `automatically_declare_parameters_from_overrides`, since how many sensors
    there are is for the parameters to say. Raises ParameterError.
    """
    given = {
        name: _plain(parameter.value)
        for name, parameter in node.get_parameters_by_prefix("").items()
        if not name.startswith(_OF_RCLPY)
    }
    settings, in_force = read_settings(given, node.get_logger())
    for sensor in settings.sensors:
        _check_topic(node, sensor)
    for name, value in in_force.items():
        # rclpy cannot tell the type of an empty list.
        if not node.has_parameter(name) and value != []:
            node.declare_parameter(name, value)
    node.add_on_set_parameters_callback(_refuse)
    return settings


def _check_topic(node: Node, sensor: Sensor) -> None:
    try:
        node.resolve_topic_name(sensor.topic)
    except InvalidTopicNameException as error:
        raise ParameterError(f"parameter {sensor.name} is not the name of a topic: {error}") from error


def _plain(value: object) -> object:
    return list(value) if isinstance(value, Sequence) and not isinstance(value, str) else value


def _refuse(parameters: list[Parameter]) -> SetParametersResult:
    fixed = [parameter.name for parameter in parameters if parameter.name != "use_sim_time"]
    if not fixed:
        return SetParametersResult(successful=True)
    reason = f"the filter reads its parameters at the start only: {', '.join(fixed)} cannot change"
    return SetParametersResult(successful=False, reason=reason)
