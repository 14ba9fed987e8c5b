"""What the filter publishes, as it goes over the wire.

Each message is serialised once, with its frames; after that only its stamp and its numbers are written into the bytes.
Filling a message object and letting rclpy serialise it costs several times as much.
"""

from struct import Struct
from typing import Any, TypeAlias

import numpy as np
from geometry_msgs.msg import AccelWithCovarianceStamped, TransformStamped
from nav_msgs.msg import Odometry
from rclpy.serialization import serialize_message

from bringup.filter.localization import Estimate
from bringup.filter.rigid import Transform
from bringup.filter.rotation import quaternion_from_rpy, rpy_from_matrix
from bringup.filter.settings import NANOSECONDS, Frames
from bringup.filter.state import ACCELERATION, POSE, TWIST, Array
from orchestra.ros.interfaces import tf_message_type

Message: TypeAlias = Any

_STAMP = Struct("=iI")
_AFTER_ENCAPSULATION = 4
_AFTER_SEQUENCE_LENGTH = 8
_DOUBLE = 8
_ODOMETRY, _ACCELERATION, _TRANSFORM = 85, 42, 7


class Form:
    """A serialised message of which a stamp and the doubles at its end are still to be filled in."""

    def __init__(self, message: Message, count: int, stamp_at: int = _AFTER_ENCAPSULATION) -> None:
        self._data = bytearray(serialize_message(message))
        self._stamp_at = stamp_at
        self.numbers = np.frombuffer(self._data, np.float64, count, len(self._data) - count * _DOUBLE)

    def stamped(self, nanoseconds: int) -> bytes:
        """Write the stamp, and give the message as it is to be sent."""
        _STAMP.pack_into(self._data, self._stamp_at, *divmod(nanoseconds, NANOSECONDS))
        return bytes(self._data)


class EstimateMessages:
    """Odometry, acceleration and transform of an estimate, with the frames of one filter."""

    def __init__(self, frames: Frames, transform: tuple[str, str]) -> None:
        odometry, acceleration = Odometry(), AccelWithCovarianceStamped()
        odometry.header.frame_id, odometry.child_frame_id = frames.world, frames.base_link_output
        acceleration.header.frame_id = frames.base_link_output
        stamped = TransformStamped()
        stamped.header.frame_id, stamped.child_frame_id = transform
        transforms = tf_message_type()()
        transforms.transforms = [stamped]
        self._odometry = Form(odometry, _ODOMETRY)
        self._acceleration = Form(acceleration, _ACCELERATION)
        self._transform = Form(transforms, _TRANSFORM, _AFTER_SEQUENCE_LENGTH)
        numbers = self._odometry.numbers
        self._pose_spread, self._twist_spread = numbers[7:43].reshape(6, 6), numbers[49:85].reshape(6, 6)

    def odometry(self, estimate: Estimate) -> bytes:
        """Write nav_msgs/Odometry: the pose in the world frame, the velocity in the base's axes."""
        state, covariance, numbers = estimate.state, estimate.covariance, self._odometry.numbers
        numbers[:7] = _place(state)
        numbers[43:49] = state[TWIST]
        self._pose_spread[:] = covariance[POSE, POSE]
        self._twist_spread[:] = covariance[TWIST, TWIST]
        return self._odometry.stamped(estimate.stamp)

    def acceleration(self, estimate: Estimate) -> bytes:
        """Write geometry_msgs/AccelWithCovarianceStamped, in the base's axes."""
        numbers = self._acceleration.numbers
        numbers[:3] = estimate.state[ACCELERATION]
        numbers[3:6] = estimate.angular_acceleration
        covariance = numbers[6:42].reshape(6, 6)
        covariance[:3, :3] = estimate.covariance[ACCELERATION, ACCELERATION]
        covariance[3:, 3:] = estimate.angular_acceleration_covariance
        return self._acceleration.stamped(estimate.stamp)

    def base(self, estimate: Estimate, offset: int) -> bytes:
        """Write tf2_msgs/TFMessage with where the estimate has the base, `offset` (ns) after its stamp."""
        self._transform.numbers[:] = _place(estimate.state)
        return self._transform.stamped(estimate.stamp + offset)

    def transform(self, place: Transform, stamp: int) -> bytes:
        """Write tf2_msgs/TFMessage with one transform at `stamp` (ns)."""
        numbers = self._transform.numbers
        numbers[:3] = place.translation
        numbers[3:7] = quaternion_from_rpy(*rpy_from_matrix(place.rotation))
        return self._transform.stamped(stamp)


def _place(state: Array) -> tuple[float, ...]:
    """Give position and quaternion of a state."""
    x, y, z, *angles = state[POSE].tolist()
    return x, y, z, *quaternion_from_rpy(*angles)


def set_stamp(stamp: Message, nanoseconds: int) -> None:
    """Fill builtin_interfaces/Time."""
    stamp.sec, stamp.nanosec = divmod(nanoseconds, NANOSECONDS)
