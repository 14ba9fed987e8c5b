"""Counts, and tells how far it has come."""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import rclpy
from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor, SetParametersResult
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Int32
from std_srvs.srv import Trigger


class Counter(Node):
    """Publishes a number on `count`, begins anew when `reset` is called, and has a parameter of each type."""

    def __init__(self, **options: Any) -> None:
        super().__init__("counter", **options)
        rates = [FloatingPointRange(from_value=0.1, to_value=100.0)]
        self.declare_parameter(
            "rate", 10.0, ParameterDescriptor(description="messages per second", floating_point_range=rates)
        )
        steps = [IntegerRange(from_value=1, to_value=100, step=1)]
        self.declare_parameter(
            "step", 1, ParameterDescriptor(description="how far to count at once", integer_range=steps)
        )
        self.declare_parameter(
            "serial", "C-1", ParameterDescriptor(description="of the device", read_only=True)
        )
        self.declare_parameter("quiet", False)
        self.declare_parameter("bytes", [b"\x01", b"\x02"])
        self.declare_parameter("flags", [True, False])
        self.declare_parameter("numbers", [1, 2, 3])
        self.declare_parameter("weights", [0.5, 1.5])
        self.declare_parameter("names", ["one", "two"])
        self.add_on_set_parameters_callback(self._consider)
        self._count = 0
        self._publisher = self.create_publisher(Int32, "count", 10)
        self._service = self.create_service(Trigger, "reset", self._reset)
        self._timer = self.create_timer(1.0 / self.get_parameter("rate").value, self._tick)

    def _consider(self, parameters: list[Any]) -> SetParametersResult:
        for parameter in parameters:
            if parameter.name == "names" and len(set(parameter.value)) < len(parameter.value):
                return SetParametersResult(successful=False, reason="two names are the same")
            if parameter.name == "rate":
                self._timer.timer_period_ns = int(1e9 / parameter.value)
        return SetParametersResult(successful=True)

    def _tick(self) -> None:
        self._count += self.get_parameter("step").value
        self._publisher.publish(Int32(data=self._count))

    def _reset(self, _request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        response.success, response.message = True, f"was {self._count}"
        self._count = 0
        return response


def main() -> None:
    """Run the node until it is told to end."""
    rclpy.init()
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(Counter())


if __name__ == "__main__":
    main()
