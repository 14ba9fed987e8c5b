"""Tells the health of a node that drives on /diagnostics, once a second of ROS time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rclpy.node import Node

PERIOD = 1.0
OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR


class Diagnostics:
    """One status with a name below the node's own."""

    def __init__(self, node: Node, title: str) -> None:
        self._clock = node.get_clock()
        self._name = f"{node.get_fully_qualified_name().lstrip('/')}: {title}"
        self._publisher = node.create_publisher(DiagnosticArray, "/diagnostics", 10)
        self._told: tuple[float, bytes] | None = None

    def is_due(self, now: float, level: bytes) -> bool:
        """Whether it is time to tell: a second has passed, the clock was set back, or the level is another one."""
        return self._told is None or level != self._told[1] or not 0.0 <= now - self._told[0] < PERIOD

    def tell(self, now: float, level: bytes, text: str, values: Mapping[str, str]) -> None:
        """Publish the status; `now` is in seconds of ROS time."""
        self._told = now, level
        message = DiagnosticArray()
        message.header.stamp = self._clock.now().to_msg()
        status = DiagnosticStatus(level=level, name=self._name, message=text, hardware_id="none")
        status.values = [KeyValue(key=key, value=value) for key, value in values.items()]
        message.status = [status]
        self._publisher.publish(message)

    def close(self, node: Node) -> None:
        """Take the publisher off the graph."""
        node.destroy_publisher(self._publisher)
