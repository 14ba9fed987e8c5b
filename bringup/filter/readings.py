"""What messages say, as plain values: the only place here that knows the layout of ROS messages.

Messages are read by their field names alone, so that rclpy's messages and those of a bag reader serve alike.
Stamps are nanoseconds; covariances are 6x6 or 3x3 matrices; frames have no leading slash (REP-105, tf2).
"""

from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from bringup.filter.rotation import Quaternion
from bringup.filter.settings import NANOSECONDS
from bringup.filter.state import Array

Message: TypeAlias = Any
Vector: TypeAlias = tuple[float, float, float]

# The first entry of an IMU covariance that stands for "this part is not measured" (sensor_msgs/Imu).
_NOT_MEASURED = -1.0


@dataclass(frozen=True, slots=True, eq=False)
class PoseReading:
    """Where `child` (empty: the base) stands in `frame`."""

    stamp: int
    frame: str
    child: str
    position: Vector
    orientation: Quaternion
    covariance: Array


@dataclass(frozen=True, slots=True, eq=False)
class TwistReading:
    """The velocity of `frame`, in the axes of `frame`."""

    stamp: int
    frame: str
    linear: Vector
    angular: Vector
    covariance: Array


@dataclass(frozen=True, slots=True, eq=False)
class OrientationReading:
    """The attitude of the sensor frame `frame` in the world."""

    stamp: int
    frame: str
    orientation: Quaternion
    covariance: Array


@dataclass(frozen=True, slots=True, eq=False)
class AccelerationReading:
    """The specific force at the sensor, in its own axes; the attitude is None where it is not measured."""

    stamp: int
    frame: str
    acceleration: Vector
    covariance: Array
    orientation: Quaternion | None


def stamp_of(message: Message) -> int:
    """Nanoseconds of a message's header stamp."""
    stamp = message.header.stamp
    return int(stamp.sec) * NANOSECONDS + int(stamp.nanosec)


def odometry_pose(message: Message) -> PoseReading:
    """Read the pose part of nav_msgs/Odometry."""
    return _pose(message, message.child_frame_id.lstrip("/"))


def pose(message: Message) -> PoseReading:
    """Read geometry_msgs/PoseWithCovarianceStamped."""
    return _pose(message, "")


def odometry_twist(message: Message) -> TwistReading:
    """Read the twist part of nav_msgs/Odometry, which is given in the child frame."""
    return _twist(message, message.child_frame_id.lstrip("/"))


def twist(message: Message) -> TwistReading:
    """Read geometry_msgs/TwistWithCovarianceStamped."""
    return _twist(message, message.header.frame_id.lstrip("/"))


def imu_orientation(message: Message) -> OrientationReading | None:
    """Read the orientation of sensor_msgs/Imu; None if it is not measured."""
    covariance = _matrix(message.orientation_covariance, 3)
    if covariance[0, 0] == _NOT_MEASURED:
        return None
    return OrientationReading(
        stamp_of(message), _frame(message), _quaternion(message.orientation), covariance
    )


def imu_twist(message: Message) -> TwistReading | None:
    """Read the angular velocity of sensor_msgs/Imu; None if it is not measured."""
    angular = _matrix(message.angular_velocity_covariance, 3)
    if angular[0, 0] == _NOT_MEASURED:
        return None
    covariance = np.zeros((6, 6))
    covariance[3:, 3:] = angular
    velocity = _vector(message.angular_velocity)
    return TwistReading(stamp_of(message), _frame(message), (0.0, 0.0, 0.0), velocity, covariance)


def imu_acceleration(message: Message) -> AccelerationReading | None:
    """Read the linear acceleration of sensor_msgs/Imu; None if it is not measured."""
    covariance = _matrix(message.linear_acceleration_covariance, 3)
    if covariance[0, 0] == _NOT_MEASURED:
        return None
    attitude = (
        None if message.orientation_covariance[0] == _NOT_MEASURED else _quaternion(message.orientation)
    )
    acceleration = _vector(message.linear_acceleration)
    return AccelerationReading(stamp_of(message), _frame(message), acceleration, covariance, attitude)


def velocity_command(twist_message: Message) -> tuple[float, ...]:
    """Read the six velocities of geometry_msgs/Twist."""
    return _vector(twist_message.linear) + _vector(twist_message.angular)


def _pose(message: Message, child: str) -> PoseReading:
    content = message.pose.pose
    return PoseReading(
        stamp=stamp_of(message),
        frame=_frame(message),
        child=child,
        position=_vector(content.position),
        orientation=_quaternion(content.orientation),
        covariance=_matrix(message.pose.covariance, 6),
    )


def _twist(message: Message, frame: str) -> TwistReading:
    content = message.twist.twist
    return TwistReading(
        stamp=stamp_of(message),
        frame=frame,
        linear=_vector(content.linear),
        angular=_vector(content.angular),
        covariance=_matrix(message.twist.covariance, 6),
    )


def _frame(message: Message) -> str:
    name: str = message.header.frame_id
    return name.lstrip("/")


def _vector(message: Message) -> Vector:
    return message.x, message.y, message.z


def _quaternion(message: Message) -> Quaternion:
    return message.x, message.y, message.z, message.w


def _matrix(values: Message, size: int) -> Array:
    return np.asarray(values, dtype=np.float64).reshape(size, size)
