"""The node's own clock, where `use_sim_time` says that it follows simulated time.

rclpy would hear what the node itself says on /clock: a hundred messages in a second, each of which wakes the thread of
the services for nothing. That took as much of the processor as the world did.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.clock_type import ClockType
from rclpy.time import Time
from rclpy.time_source import TimeSource

from bringup.world.messages import NANOSECONDS_PER_TICK

if TYPE_CHECKING:
    from rclpy.node import Node


class OwnTime:
    """Sets the clock of the node that makes the time. To be made before an executor has the node."""

    def __init__(self, node: Node) -> None:
        self._clock = node.get_clock()
        for subscription in list(node.subscriptions):
            if getattr(subscription.callback, "__func__", None) is TimeSource.clock_callback:
                node.destroy_subscription(subscription)

    def set(self, ticks: int) -> None:
        """Let it be the time of a tick, unless the clock goes by the machine's time."""
        if self._clock.ros_time_is_active:
            time = Time(nanoseconds=ticks * NANOSECONDS_PER_TICK, clock_type=ClockType.ROS_TIME)
            self._clock.set_ros_time_override(time)
