"""Tells the double of what it hears."""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Int32


class Doubler(Node):
    """Hears numbers on `count` and publishes their doubles on `double`."""

    def __init__(self, **options: Any) -> None:
        super().__init__("doubler", **options)
        self._publisher = self.create_publisher(Int32, "double", 10)
        self._subscription = self.create_subscription(Int32, "count", self._heard, 10)

    def _heard(self, message: Int32) -> None:
        self._publisher.publish(Int32(data=2 * message.data))


def main() -> None:
    """Run the node until it is told to end."""
    rclpy.init()
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(Doubler())


if __name__ == "__main__":
    main()
