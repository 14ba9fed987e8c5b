"""What messages say, as plain values.

The only place here that knows the layout of ROS messages. They are read by their field names alone, so that rclpy's
messages and those of a bag reader serve alike; who has them in another form makes a `Heard` of them. Tuples, because
they are made for each message, and frozen dataclasses take five times as long to make.
Stamps are nanoseconds; covariances are 6x6 or 3x3 matrices, row by row; frames have no leading slash (REP-105, tf2).
"""

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from bringup.filter.rotation import Quaternion, Vector
from bringup.filter.settings import NANOSECONDS, Kind

Message: TypeAlias = Any
Numbers: TypeAlias = tuple[float, ...]

# The first entry of an IMU covariance that stands for "this part is not measured" (sensor_msgs/Imu).
_NOT_MEASURED = -1.0
_POSE = 43


class Heard(NamedTuple):
    """A sensor's message: its stamp, its frames and its numbers in the order of the message's definition."""

    stamp: int
    frame: str
    child: str
    numbers: Numbers


class PoseReading(NamedTuple):
    """Where `child` (empty: the base) stands in `frame`."""

    stamp: int
    frame: str
    child: str
    position: Vector
    orientation: Quaternion
    covariance: Numbers


class TwistReading(NamedTuple):
    """The velocity of `frame`, in the axes of `frame`."""

    stamp: int
    frame: str
    linear: Vector
    angular: Vector
    covariance: Numbers


class OrientationReading(NamedTuple):
    """The attitude of the sensor frame `frame` in the world."""

    stamp: int
    frame: str
    orientation: Quaternion
    covariance: Numbers


class TurningReading(NamedTuple):
    """The angular velocity of the sensor frame `frame`, in its own axes."""

    stamp: int
    frame: str
    angular: Vector
    covariance: Numbers


class AccelerationReading(NamedTuple):
    """The specific force at the sensor, in its own axes; the attitude is None where it is not measured."""

    stamp: int
    frame: str
    acceleration: Vector
    covariance: Numbers
    orientation: Quaternion | None


def stamp_of(message: Message) -> int:
    """Nanoseconds of a message's header stamp."""
    stamp = message.header.stamp
    return int(stamp.sec) * NANOSECONDS + int(stamp.nanosec)


def heard(kind: Kind, message: Message) -> Heard:
    """Read a message of nav_msgs/Odometry, geometry_msgs/PoseWithCovarianceStamped and so on."""
    return _HEARD[kind](message)


def odometry_pose(said: Heard) -> PoseReading:
    """Read the pose part of nav_msgs/Odometry."""
    return _pose(said, said.child)


def pose(said: Heard) -> PoseReading:
    """Read geometry_msgs/PoseWithCovarianceStamped."""
    return _pose(said, "")


def odometry_twist(said: Heard) -> TwistReading:
    """Read the twist part of nav_msgs/Odometry, which is given in the child frame."""
    return _twist(said, said.child, _POSE)


def twist(said: Heard) -> TwistReading:
    """Read geometry_msgs/TwistWithCovarianceStamped."""
    return _twist(said, said.frame, 0)


def imu_orientation(said: Heard) -> OrientationReading | None:
    """Read the orientation of sensor_msgs/Imu; None if it is not measured."""
    numbers = said.numbers
    if numbers[4] == _NOT_MEASURED:
        return None
    x, y, z, w = numbers[:4]
    return OrientationReading(said.stamp, said.frame, (x, y, z, w), numbers[4:13])


def imu_turning(said: Heard) -> TurningReading | None:
    """Read the angular velocity of sensor_msgs/Imu; None if it is not measured."""
    numbers = said.numbers
    if numbers[16] == _NOT_MEASURED:
        return None
    x, y, z = numbers[13:16]
    return TurningReading(said.stamp, said.frame, (x, y, z), numbers[16:25])


def imu_acceleration(said: Heard) -> AccelerationReading | None:
    """Read the linear acceleration of sensor_msgs/Imu; None if it is not measured."""
    numbers = said.numbers
    if numbers[28] == _NOT_MEASURED:
        return None
    attitude: Quaternion | None = None
    if numbers[4] != _NOT_MEASURED:
        x, y, z, w = numbers[:4]
        attitude = (x, y, z, w)
    x, y, z = numbers[25:28]
    return AccelerationReading(said.stamp, said.frame, (x, y, z), numbers[28:37], attitude)


def velocity_command(twist_message: Message) -> Numbers:
    """Read the six velocities of geometry_msgs/Twist."""
    return _vector(twist_message.linear) + _vector(twist_message.angular)


def _pose(said: Heard, child: str) -> PoseReading:
    x, y, z, qx, qy, qz, qw = said.numbers[:7]
    return PoseReading(said.stamp, said.frame, child, (x, y, z), (qx, qy, qz, qw), said.numbers[7:_POSE])


def _twist(said: Heard, frame: str, start: int) -> TwistReading:
    vx, vy, vz, wx, wy, wz = said.numbers[start : start + 6]
    covariance = said.numbers[start + 6 : start + 42]
    return TwistReading(said.stamp, frame, (vx, vy, vz), (wx, wy, wz), covariance)


def _heard_odometry(message: Message) -> Heard:
    numbers = _pose_numbers(message.pose) + _twist_numbers(message.twist)
    return _with_header(message, message.child_frame_id.lstrip("/"), numbers)


def _heard_pose(message: Message) -> Heard:
    return _with_header(message, "", _pose_numbers(message.pose))


def _heard_twist(message: Message) -> Heard:
    return _with_header(message, "", _twist_numbers(message.twist))


def _heard_imu(message: Message) -> Heard:
    numbers = [
        *_quaternion(message.orientation),
        *_flat(message.orientation_covariance),
        *_vector(message.angular_velocity),
        *_flat(message.angular_velocity_covariance),
        *_vector(message.linear_acceleration),
        *_flat(message.linear_acceleration_covariance),
    ]
    return _with_header(message, "", numbers)


_HEARD: dict[Kind, Callable[[Message], Heard]] = {
    "odom": _heard_odometry,
    "pose": _heard_pose,
    "twist": _heard_twist,
    "imu": _heard_imu,
}


def _with_header(message: Message, child: str, numbers: list[float]) -> Heard:
    return Heard(stamp_of(message), message.header.frame_id.lstrip("/"), child, tuple(numbers))


def _pose_numbers(part: Message) -> list[float]:
    return [*_vector(part.pose.position), *_quaternion(part.pose.orientation), *_flat(part.covariance)]


def _twist_numbers(part: Message) -> list[float]:
    return [*_vector(part.twist.linear), *_vector(part.twist.angular), *_flat(part.covariance)]


def _vector(message: Message) -> Vector:
    return message.x, message.y, message.z


def _quaternion(message: Message) -> Quaternion:
    return message.x, message.y, message.z, message.w


def _flat(values: Message) -> list[float]:
    return values.tolist() if isinstance(values, np.ndarray) else list(values)
