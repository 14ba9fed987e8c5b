"""Measures, and tells it to whoever happens to hear it."""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from std_msgs.msg import Int32


class Gauge(Node):
    """Publishes numbers on `level` with the quality of service of sensors: best effort."""

    def __init__(self, **options: Any) -> None:
        super().__init__("gauge", **options)
        self._publisher = self.create_publisher(Int32, "level", qos_profile_sensor_data)
        self._timer = self.create_timer(0.1, lambda: self._publisher.publish(Int32(data=1)))


def main() -> None:
    """Run the node until it is told to end."""
    rclpy.init()
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(Gauge())


if __name__ == "__main__":
    main()
