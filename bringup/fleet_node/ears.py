"""What is heard of one robot: the last of its odometry, its mode, its contacts."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeAlias

from nav_msgs.msg import Odometry
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String, UInt32

from bringup.fleet.discovery import inside
from bringup.fleet.frames import Place
from bringup.fleet.robots import Motion
from bringup.fleet_node import visited
from bringup.fleet_node.graph import mode_topic

if TYPE_CHECKING:
    from rclpy.node import Node

    from bringup.fleet.robots import Robot
    from bringup.fleet.settings import Settings

Message: TypeAlias = Any

NANOSECONDS = 1_000_000_000
_LAST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
_LATCHED = QoSProfile(
    depth=1, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL
)


class Ears:
    """The subscriptions for one robot."""

    def __init__(self, node: Node, robot: str, settings: Settings) -> None:
        self._node = node
        self._odometry = visited.subscribe(node, Odometry, inside(robot, settings.odometry), _LAST)
        self._mode = visited.subscribe(node, String, mode_topic(robot, settings), _LATCHED)
        self._contacts = visited.subscribe(node, UInt32, inside(robot, "contacts"), _LATCHED)

    def heard(self, robot: Robot, now: int) -> Robot:
        """Return the robot as it is after what has come since the last time, at a ROS time in ns."""
        for message in visited.messages(self._odometry):
            robot = replace(robot, motion=_motion(message, now))
        for message in visited.messages(self._mode):
            robot = replace(robot, mode=message.data)
        for message in visited.messages(self._contacts):
            robot = replace(robot, contacts=message.data)
        return robot

    def close(self) -> None:
        """End the subscriptions."""
        for each in (self._odometry, self._mode, self._contacts):
            self._node.destroy_subscription(each)


def place_of(frame: str, pose: Message) -> Place:
    """Return geometry_msgs/Pose in the plane."""
    return Place(frame.lstrip("/"), pose.position.x, pose.position.y, yaw_of(pose.orientation))


def yaw_of(turn: Message) -> float:
    """Return the turn about the vertical axis of geometry_msgs/Quaternion, in radians."""
    return math.atan2(2 * (turn.w * turn.z + turn.x * turn.y), 1 - 2 * (turn.y * turn.y + turn.z * turn.z))


def stamp_of(header: Message) -> int:
    """Return a header's time in ns."""
    return int(header.stamp.sec) * NANOSECONDS + int(header.stamp.nanosec)


def _motion(message: Message, now: int) -> Motion:
    made = stamp_of(message.header)
    twist = message.twist.twist
    return Motion(
        # A stamp of another clock says nothing of the age: then it counts from when it was heard.
        made if 0 < made <= now else now,
        place_of(message.header.frame_id, message.pose.pose),
        twist.linear.x,
        twist.angular.z,
    )
