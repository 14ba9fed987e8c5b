"""Loads a component into a container."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import Parameter as ParameterMessage
from rcl_interfaces.msg import ParameterType, ParameterValue
from rcl_interfaces.srv import ListParameters
from rclpy.parameter import Parameter

from orchestra.ros.interfaces import load_node_type
from orchestra.ros.observer.order import OFTEN, ImpossibleError
from orchestra.ros.observer.service import OwnService

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rclpy.node import Node

    from orchestra.ros.observer.order import Request, Say

# A container without parameter services is not asked for its parameters first; found out after this time, in seconds.
_INTRODUCED_WITHIN = 2.0


class ComponentLoad:
    """`container` is the full name of the container's node, `component` the fields of the request.

    A response that comes before the container has discovered our reader is lost, and a component must not be loaded
    twice. So the container is asked something harmless first: its answer shows that it knows our readers, which
    discovery tells of in the order in which they were made.
    """

    def __init__(self, node: Node, request: Request, say: Say) -> None:
        self._say = say
        self._fields: Mapping[str, Any] = request["component"]
        self._there_since: float | None = None
        container = request["container"]
        try:
            self._kind = load_node_type()
        except ImportError as error:
            raise ImpossibleError(str(error)) from error
        self._load = OwnService(node, self._kind, f"{container}/_container/load_node")
        self._parameters = OwnService(node, ListParameters, f"{container}/list_parameters")
        self.every: float | None = OFTEN

    def look(self) -> None:
        """Begin as soon as the container takes orders."""
        if not self._load.ready:
            return
        if self._there_since is None:
            self._there_since = time.monotonic()
            self._say("asking")
        if self._parameters.asked:
            self._parameters.look()
        elif self._parameters.ready:
            self._parameters.ask(ListParameters.Request(), self._greeted, repeat=True)
        elif time.monotonic() > self._there_since + _INTRODUCED_WITHIN:
            self._begin()

    def close(self) -> None:
        """Give the clients back."""
        self._load.close()
        self._parameters.close()

    def _greeted(self, _response: object) -> None:
        if self.every:
            self._begin()

    def _begin(self) -> None:
        self.every = None
        request = self._kind.Request()
        for name, value in self._fields.items():
            listed = name in ("parameters", "extra_arguments")
            setattr(request, name, [_parameter(*item) for item in value.items()] if listed else value)
        self._load.ask(request, self._answered)

    def _answered(self, response: Any) -> None:  # noqa: ANN401 - of an untyped package
        if response.success:
            self._say("done", node=response.full_node_name, unique_id=response.unique_id)
        else:
            self._say("impossible", reason=response.error_message or "the container gives no reason")


def _parameter(name: str, value: Any) -> ParameterMessage:  # noqa: ANN401 - a value of any of ROS's types
    if value == []:  # of no type that anybody could tell: as texts, since most lists are
        return ParameterMessage(
            name=name, value=ParameterValue(type=ParameterType.PARAMETER_STRING_ARRAY, string_array_value=[])
        )
    return Parameter(name, value=value).to_parameter_msg()
