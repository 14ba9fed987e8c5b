"""A node with a parameter, a topic and a timer, as most are: one_of_many.py NAME NUMBER. As a component: `Idle`."""

import sys
from contextlib import suppress
from typing import Any

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class Idle(Node):
    def __init__(self, node_name: str = "idle", number: int = 0, **options: Any) -> None:
        super().__init__(node_name, **options)
        self.declare_parameter("number", number)
        self._publisher = self.create_publisher(String, "~/said", 10)
        self.create_timer(1.0, lambda: self._publisher.publish(String(data="x")))


def main() -> None:
    rclpy.init()
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(Idle(sys.argv[1], int(sys.argv[2])))


if __name__ == "__main__":
    main()
