"""Fills the messages that the filter publishes; each message object is made once and used again."""

from typing import Any, TypeAlias

import numpy as np
from geometry_msgs.msg import AccelWithCovarianceStamped, TransformStamped
from nav_msgs.msg import Odometry

from bringup.filter.localization import Estimate
from bringup.filter.rigid import Transform
from bringup.filter.rotation import quaternion_from_rpy, rpy_from_matrix
from bringup.filter.settings import NANOSECONDS, Frames
from bringup.filter.state import ACCELERATION, POSE, TWIST, Array

Message: TypeAlias = Any


class EstimateMessages:
    """Odometry, acceleration and transform of an estimate, with the frames of one filter."""

    def __init__(self, frames: Frames) -> None:
        self._odometry = Odometry()
        self._odometry.header.frame_id = frames.world
        self._odometry.child_frame_id = frames.base_link_output
        self._acceleration = AccelWithCovarianceStamped()
        self._acceleration.header.frame_id = frames.base_link_output
        self._transform = TransformStamped()

    def odometry(self, estimate: Estimate) -> Message:
        """Fill nav_msgs/Odometry: the pose in the world frame, the velocity in the base's axes."""
        message = self._odometry
        set_stamp(message.header.stamp, estimate.stamp)
        x, y, z, roll, pitch, yaw, *velocity = estimate.state[: TWIST.stop].tolist()
        _set_vector(message.pose.pose.position, x, y, z)
        _set_quaternion(message.pose.pose.orientation, *quaternion_from_rpy(roll, pitch, yaw))
        _set_vector(message.twist.twist.linear, *velocity[:3])
        _set_vector(message.twist.twist.angular, *velocity[3:])
        message.pose.covariance = _flat(estimate.covariance[POSE, POSE])
        message.twist.covariance = _flat(estimate.covariance[TWIST, TWIST])
        return message

    def acceleration(self, estimate: Estimate) -> Message:
        """Fill geometry_msgs/AccelWithCovarianceStamped, in the base's axes."""
        message = self._acceleration
        set_stamp(message.header.stamp, estimate.stamp)
        _set_vector(message.accel.accel.linear, *estimate.state[ACCELERATION].tolist())
        _set_vector(message.accel.accel.angular, *estimate.angular_acceleration.tolist())
        covariance = np.zeros((6, 6))
        covariance[:3, :3] = estimate.covariance[ACCELERATION, ACCELERATION]
        covariance[3:, 3:] = estimate.angular_acceleration_covariance
        message.accel.covariance = _flat(covariance)
        return message

    def transform(self, parent: str, child: str, stamp: int, place: Transform) -> Message:
        """Fill geometry_msgs/TransformStamped."""
        message = self._transform
        set_stamp(message.header.stamp, stamp)
        message.header.frame_id = parent
        message.child_frame_id = child
        _set_vector(message.transform.translation, *place.translation.tolist())
        _set_quaternion(message.transform.rotation, *quaternion_from_rpy(*rpy_from_matrix(place.rotation)))
        return message


def set_stamp(stamp: Message, nanoseconds: int) -> None:
    """Fill builtin_interfaces/Time."""
    stamp.sec, stamp.nanosec = divmod(nanoseconds, NANOSECONDS)


def _set_vector(message: Message, x: float, y: float, z: float) -> None:
    message.x, message.y, message.z = x, y, z


def _set_quaternion(message: Message, x: float, y: float, z: float, w: float) -> None:
    message.x, message.y, message.z, message.w = x, y, z, w


def _flat(covariance: Array) -> Array:
    return np.ascontiguousarray(covariance).reshape(-1)
