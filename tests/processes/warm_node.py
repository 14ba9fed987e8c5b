#!/usr/bin/env python3
# ruff: noqa: T201 - it is to print
"""A node that publishes, and ends by SIGINT; with `crash` it ends with status 9 as soon as it has published."""

import sys

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class Publishing(Node):
    def __init__(self) -> None:
        super().__init__("publishing")
        self.declare_parameter("rate", 50.0)
        self._publisher = self.create_publisher(String, "said", 10)
        self.create_timer(1.0 / self.get_parameter("rate").value, self._publish)
        self.create_subscription(String, "said", self._heard, 10)

    def _publish(self) -> None:
        self._publisher.publish(String(data="x"))

    def _heard(self, message: String) -> None:
        print(f"heard {message.data}", flush=True)
        if "crash" in sys.argv:
            sys.exit(9)


rclpy.init()
try:
    rclpy.spin(Publishing())
except (KeyboardInterrupt, ExternalShutdownException):
    print("leaves", flush=True)
