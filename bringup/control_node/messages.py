"""From and to messages, for the nodes that drive."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, TypeAlias

from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Twist, TwistStamped

from bringup.control.command import Command, Pose

if TYPE_CHECKING:
    from builtin_interfaces.msg import Time

Message: TypeAlias = Any

NANOSECONDS = 1_000_000_000


def seconds(stamp: Time) -> float:
    """A stamp in seconds."""
    return float(stamp.sec) + float(stamp.nanosec) / NANOSECONDS


def duration(length: float) -> Duration:
    """So many seconds as a message; nothing for less than none."""
    whole, rest = divmod(round(max(length, 0.0) * NANOSECONDS), NANOSECONDS)
    return Duration(sec=whole, nanosec=rest)


def yaw(turn: Message) -> float:
    """The heading of a quaternion, in -π..π."""
    return math.atan2(
        2.0 * (turn.w * turn.z + turn.x * turn.y), 1.0 - 2.0 * (turn.y * turn.y + turn.z * turn.z)
    )


def pose_of(pose: Message) -> Pose | None:
    """What a geometry_msgs/Pose says in the plane; None if it is no numbers."""
    found = Pose(pose.position.x, pose.position.y, yaw(pose.orientation))
    return found if all(map(math.isfinite, (found.x, found.y, found.yaw))) else None


def fill_pose(message: Message, pose: Pose) -> None:
    """Write a pose of the plane into a geometry_msgs/Pose."""
    message.position.x, message.position.y = pose.x, pose.y
    message.orientation.z, message.orientation.w = math.sin(pose.yaw / 2.0), math.cos(pose.yaw / 2.0)


def twist_type(stamped: bool) -> type[Message]:
    """The message that carries a velocity."""
    return TwistStamped if stamped else Twist  # type: ignore[no-any-return] # the packages are untyped


def fill_command(message: Message, command: Command, stamp: Time, frame: str) -> None:
    """Write a velocity into a Twist or a TwistStamped."""
    twist = message
    if isinstance(message, TwistStamped):
        message.header.stamp, message.header.frame_id = stamp, frame
        twist = message.twist
    twist.linear.x, twist.angular.z = command.linear, command.angular


def command_of(message: Message) -> Command:
    """The velocity in a Twist or a TwistStamped."""
    twist = message.twist if isinstance(message, TwistStamped) else message
    return Command(twist.linear.x, twist.angular.z)
