"""What a robot says, as messages that are written straight into their bytes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState

from bringup.world import messages
from bringup.world.wire import Wire

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from rclpy.node import Node
    from rclpy.qos import QoSProfile

    from bringup.world.drive import Twist
    from bringup.world.geometry import Pose
    from bringup.world.lidar import LidarErrors
    from bringup.world.odometry import Estimate
    from bringup.world.sensing import InertialReading, Truth

STAMP = ("header.stamp.sec", "iI")
# Places of (x, y, yaw) squared and of (vx, vyaw) squared among the 36 entries of a covariance.
PLANAR = np.array([0, 1, 5, 6, 7, 11, 30, 31, 35])
DRIVEN = np.array([0, 5, 30, 35])


class ClockOut:
    """The clock."""

    def __init__(self, node: Node, qos: QoSProfile) -> None:
        self._wire = Wire(node, "/clock", Clock(), qos, stamp=("clock.sec", "iI"))

    def publish(self, ticks: int) -> None:
        """Tell the time of a tick."""
        self._wire.write("stamp", *messages.seconds(ticks))
        self._wire.publish()


class OdometryOut:
    """Odometry: a pose, a velocity and how sure they are."""

    def __init__(self, node: Node, topic: str, message: Any, qos: QoSProfile) -> None:  # noqa: ANN401 - messages have no types
        self._wire = Wire(
            node,
            topic,
            message,
            qos,
            stamp=STAMP,
            pose=("pose.pose.position.x", "7d"),
            twist=("twist.twist.linear.x", "6d"),
            pose_covariance=("pose.covariance.0", "36d"),
            twist_covariance=("twist.covariance.0", "36d"),
        )
        self._pose_covariance, self._twist_covariance = (
            np.frombuffer(self._wire.bytes, "<f8", 36, self._wire.at(f"{kind}_covariance"))
            for kind in ("pose", "twist")
        )

    def publish_truth(self, ticks: int, truth: Truth) -> None:
        """Tell how the robot moves."""
        self._publish(ticks, truth.pose, truth.twist, truth.sideways)

    def publish_estimate(self, ticks: int, estimate: Estimate) -> None:
        """Tell how the wheels believe that it moves."""
        self._pose_covariance[PLANAR] = estimate.pose_covariance.ravel()
        self._twist_covariance[DRIVEN] = estimate.twist_covariance.ravel()
        self._publish(ticks, estimate.pose, estimate.twist)

    def _publish(self, ticks: int, pose: Pose, twist: Twist, sideways: float = 0.0) -> None:
        wire, half = self._wire, pose.yaw / 2
        wire.write("stamp", *messages.seconds(ticks))
        wire.write("pose", pose.x, pose.y, 0.0, 0.0, 0.0, math.sin(half), math.cos(half))
        wire.write("twist", twist.linear, sideways, 0.0, 0.0, 0.0, twist.angular)
        wire.publish()


class InertialOut:
    """What the IMU feels."""

    def __init__(self, node: Node, topic: str, message: Any, qos: QoSProfile) -> None:  # noqa: ANN401 - messages have no types
        self._wire = Wire(
            node,
            topic,
            message,
            qos,
            stamp=STAMP,
            rate=("angular_velocity.x", "12d"),
            force=("linear_acceleration.x", "12d"),
        )

    def publish(self, ticks: int, reading: InertialReading) -> None:
        """Tell turning rates and accelerations, each three with a diagonal covariance."""
        wire, values = self._wire, reading.values
        gyro, accelerometer = _diagonal(reading.gyro_variance), _diagonal(reading.accelerometer_variance)
        wire.write("stamp", *messages.seconds(ticks))
        wire.write("rate", *values[:3], *gyro)
        wire.write("force", *values[3:], *accelerometer)
        wire.publish()


class ScanOut:
    """What the lidar sees."""

    def __init__(self, node: Node, topic: str, message: Any, qos: QoSProfile) -> None:  # noqa: ANN401 - messages have no types
        self._wire = Wire(
            node,
            topic,
            message,
            qos,
            stamp=STAMP,
            span=("scan_time", "3f"),
            ranges=("ranges.0", "f"),
        )
        self._ranges = np.frombuffer(self._wire.bytes, "<f4", len(message.ranges), self._wire.at("ranges"))

    def publish(self, ticks: int, ranges: NDArray[np.float64], rate: float, errors: LidarErrors) -> None:
        """Tell the ranges of a scan, taken so often in a second within such limits."""
        self._wire.write("stamp", *messages.seconds(ticks))
        self._wire.write("span", 1.0 / rate, errors.range_min, errors.range_max)
        self._ranges[:] = ranges
        self._wire.publish()


class JointsOut:
    """How the wheels stand and turn."""

    def __init__(self, node: Node, topic: str, joints: list[str], qos: QoSProfile) -> None:
        message = JointState(name=joints, position=[0.0] * len(joints), velocity=[0.0] * len(joints))
        form = f"{len(joints)}d"
        self._wire = Wire(
            node,
            topic,
            message,
            qos,
            stamp=STAMP,
            position=("position.0", form),
            velocity=("velocity.0", form),
        )

    def publish(self, ticks: int, angles: tuple[float, ...], speeds: tuple[float, ...]) -> None:
        """Tell angles and speeds in the order of the joints, in rad and rad/s."""
        self._wire.write("stamp", *messages.seconds(ticks))
        self._wire.write("position", *angles)
        self._wire.write("velocity", *speeds)
        self._wire.publish()


def _diagonal(variance: float) -> tuple[float, ...]:
    return (variance, 0.0, 0.0, 0.0, variance, 0.0, 0.0, 0.0, variance)
