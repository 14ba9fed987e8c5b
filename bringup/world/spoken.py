"""What a robot says, as messages that are written straight into their bytes.

Whoever has one of these asks its wire whether it is heard before it says something: half of what the sensors cost is
spared in a world to which nobody listens.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState

from bringup.world import messages
from bringup.world.wire import Message, Wire

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from rclpy.node import Node
    from rclpy.qos import QoSProfile
    from sensor_msgs.msg import LaserScan

    from bringup.world.drive import Twist
    from bringup.world.geometry import Pose
    from bringup.world.lidar import LidarErrors
    from bringup.world.odometry import Estimate
    from bringup.world.sensing import InertialReading, Truth

STAMP = ("header.stamp.sec", "iI")


class ClockOut:
    """The clock."""

    def __init__(self, node: Node, qos: QoSProfile) -> None:
        self.wire = Wire(node, "/clock", Clock(), qos)
        self._stamp = self.wire.slot("clock.sec", "iI")

    def publish(self, ticks: int) -> None:
        """Tell the time of a tick."""
        if self.wire.heard:
            self._stamp(*messages.seconds(ticks))
            self.wire.publish()


class OdometryOut:
    """Odometry: a pose, a velocity and how sure they are."""

    def __init__(self, node: Node, topic: str, message: Message, qos: QoSProfile) -> None:
        self.wire = wire = Wire(node, topic, message, qos)
        self._stamp = wire.slot(*STAMP)
        self._pose = wire.slot("pose.pose.position.x", "7d")
        self._twist = wire.slot("twist.twist.linear.x", "6d")
        self._pose_covariance = wire.doubles("pose.covariance.0", 36)
        self._twist_covariance = wire.doubles("twist.covariance.0", 36)

    def publish_truth(self, ticks: int, truth: Truth) -> None:
        """Tell how the robot moves."""
        self._publish(ticks, truth.pose, truth.twist, truth.sideways)

    def publish_estimate(self, ticks: int, estimate: Estimate) -> None:
        """Tell how the wheels believe that it moves."""
        # Rows and columns of (x, y, yaw) are 0, 1 and 5 of six, those of (vx, vyaw) 0 and 5.
        pose, twist = self._pose_covariance, self._twist_covariance
        pose[0], pose[1], pose[5], pose[7], pose[11], pose[35] = estimate.pose_spread
        pose[6], pose[30], pose[31] = pose[1], pose[5], pose[11]
        twist[0], twist[5], twist[35] = estimate.twist_spread
        twist[30] = twist[5]
        self._publish(ticks, estimate.pose, estimate.twist)

    def _publish(self, ticks: int, pose: Pose, twist: Twist, sideways: float = 0.0) -> None:
        half = pose.yaw / 2
        self._stamp(*messages.seconds(ticks))
        self._pose(pose.x, pose.y, 0.0, 0.0, 0.0, math.sin(half), math.cos(half))
        self._twist(twist.linear, sideways, 0.0, 0.0, 0.0, twist.angular)
        self.wire.publish()


class InertialOut:
    """What the IMU feels."""

    def __init__(self, node: Node, topic: str, message: Message, qos: QoSProfile) -> None:
        self.wire = wire = Wire(node, topic, message, qos)
        self._stamp = wire.slot(*STAMP)
        self._rate = wire.slot("angular_velocity.x", "3d")
        self._force = wire.slot("linear_acceleration.x", "3d")
        self._rate_covariance = wire.slot("angular_velocity_covariance.0", "9d")
        self._force_covariance = wire.slot("linear_acceleration_covariance.0", "9d")
        self._variances = (math.nan, math.nan)

    def publish(self, ticks: int, reading: InertialReading) -> None:
        """Tell turning rates and accelerations, each three with a diagonal covariance."""
        self._stamp(*messages.seconds(ticks))
        self._rate(*reading.values[:3])
        self._force(*reading.values[3:])
        if reading.variances != self._variances:
            self._variances = gyro, accelerometer = reading.variances
            self._rate_covariance(*_diagonal(gyro))
            self._force_covariance(*_diagonal(accelerometer))
        self.wire.publish()


class ScanOut:
    """What the lidar sees."""

    def __init__(self, node: Node, topic: str, message: LaserScan, qos: QoSProfile) -> None:
        self.wire = wire = Wire(node, topic, message, qos)
        self._stamp = wire.slot(*STAMP)
        self._span = wire.slot("scan_time", "3f")
        self._ranges = wire.view("ranges.0", "f", len(message.ranges))

    def publish(self, ticks: int, ranges: NDArray[np.float64], rate: float, errors: LidarErrors) -> None:
        """Tell the ranges of a scan, taken so often in a second within such limits."""
        self._stamp(*messages.seconds(ticks))
        self._span(1.0 / rate, errors.range_min, errors.range_max)
        self._ranges[:] = ranges
        self.wire.publish()


class JointsOut:
    """How the wheels stand and turn."""

    def __init__(self, node: Node, topic: str, joints: list[str], qos: QoSProfile) -> None:
        message = JointState(name=joints, position=[0.0] * len(joints), velocity=[0.0] * len(joints))
        self.wire = wire = Wire(node, topic, message, qos)
        self._stamp = wire.slot(*STAMP)
        self._position = wire.slot("position.0", f"{len(joints)}d")
        self._velocity = wire.slot("velocity.0", f"{len(joints)}d")

    def publish(self, ticks: int, angles: tuple[float, ...], speeds: tuple[float, ...]) -> None:
        """Tell angles and speeds in the order of the joints, in rad and rad/s."""
        self._stamp(*messages.seconds(ticks))
        self._position(*angles)
        self._velocity(*speeds)
        self.wire.publish()


def _diagonal(variance: float) -> tuple[float, ...]:
    return (variance, 0.0, 0.0, 0.0, variance, 0.0, 0.0, 0.0, variance)
