"""A node has a parameter, with a value if one is named.

The node is asked over its parameter service until it is so; a parameter that is declared but has no value yet is not
there.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import Parameter as ParameterMessage
from rcl_interfaces.srv import GetParameters
from rclpy.parameter import Parameter

from orchestra.ros.observer.order import OFTEN
from orchestra.ros.observer.service import OwnService

if TYPE_CHECKING:
    from rclpy.node import Node

    from orchestra.ros.observer.order import Request, Say

# In seconds.
_ASK_ANEW = 0.5


class ParameterThere:
    """`node` is the full name of the node, `name` that of the parameter; `value` its value, None for any."""

    def __init__(self, node: Node, request: Request, say: Say) -> None:
        self._say = say
        self._request = GetParameters.Request(names=[request["name"]])
        self._wanted = request.get("value")
        self._service = OwnService(node, GetParameters, f"{request['node']}/get_parameters")
        self._ask_at = 0.0
        self.every: float | None = OFTEN

    def look(self) -> None:
        """Ask for the value where it is time."""
        if self._service.asked:
            self._service.look()
        elif self._service.ready and time.monotonic() >= self._ask_at:
            self._service.ask(self._request, self._answered, repeat=True)

    def close(self) -> None:
        """Give the client back."""
        self._service.close()

    def _answered(self, response: Any) -> None:  # noqa: ANN401 - of an untyped package
        self._ask_at = time.monotonic() + _ASK_ANEW
        # rclcpp gives no value at all for a parameter that is not declared, rclpy one that is not set.
        held = [value for value in response.values if value.type != Parameter.Type.NOT_SET.value]
        if self.every and held and (self._wanted is None or same_value(held[0], self._wanted)):
            self.every = None
            self._say("done")


def same_value(held: Any, wanted: Any) -> bool:  # noqa: ANN401 - as above, and a value of any of ROS's types
    """Tell whether a rcl_interfaces/msg/ParameterValue is this value, type and all: 1 is not 1.0, nor true.

    An empty list is the same whatever its elements would be.
    """
    value = Parameter.from_parameter_msg(ParameterMessage(name="it", value=held)).value
    if wanted == []:
        return not isinstance(value, str) and hasattr(value, "__len__") and len(value) == 0
    kind = Parameter.Type.from_parameter_value(wanted)
    return bool(kind.value == held.type and (list(value) if isinstance(wanted, list) else value) == wanted)
