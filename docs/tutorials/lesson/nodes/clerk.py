"""Writes down what it hears, and wants to hear all of it."""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Int32


class Clerk(Node):
    """Hears numbers on `level`, reliably: from a publisher with best effort it hears nothing."""

    def __init__(self, **options: Any) -> None:
        super().__init__("clerk", **options)
        self._subscription = self.create_subscription(Int32, "level", self._heard, 10)

    def _heard(self, message: Int32) -> None:
        self.get_logger().info(f"level {message.data}")


def main() -> None:
    """Run the node until it is told to end."""
    rclpy.init()
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(Clerk())


if __name__ == "__main__":
    main()
