"""Stands for the drivers of a real robot: a base that goes as it is told, in an empty place, by the machine's clock.

`python base.py --ros-args -r __ns:=/robot1`: takes `base/cmd_vel`; gives `base/odom`, `base/imu` and `lidar/scan`.
"""

from __future__ import annotations

import math
from contextlib import suppress
from typing import Any

import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import Imu, LaserScan

PERIOD = 0.02  # seconds
SCAN_EVERY = 5
BEAMS = 360


class Base(Node):
    """The base and its sensors."""

    def __init__(self) -> None:
        super().__init__("base")
        self.told, self.x, self.y, self.yaw, self.turn = Twist(), 0.0, 0.0, 0.0, 0
        self.prefix = self.get_namespace().strip("/")
        self.create_subscription(Twist, "base/cmd_vel", self.take, 1)
        self.odometry = self.create_publisher(Odometry, "base/odom", 10)
        self.imu = self.create_publisher(Imu, "base/imu", 10)
        self.scan = self.create_publisher(LaserScan, "lidar/scan", 10)
        self.create_timer(PERIOD, self.step)

    def take(self, message: Twist) -> None:
        self.told = message

    def step(self) -> None:
        self.turn += 1
        speed, rate = self.told.linear.x, self.told.angular.z
        self.x += speed * math.cos(self.yaw) * PERIOD
        self.y += speed * math.sin(self.yaw) * PERIOD
        self.yaw += rate * PERIOD
        odometry = self.stamped(Odometry(), "odom")
        odometry.child_frame_id = f"{self.prefix}/base_footprint"
        odometry.pose.pose.position.x, odometry.pose.pose.position.y = self.x, self.y
        odometry.pose.pose.orientation.z = math.sin(self.yaw / 2)
        odometry.pose.pose.orientation.w = math.cos(self.yaw / 2)
        odometry.twist.twist.linear.x, odometry.twist.twist.angular.z = speed, rate
        odometry.pose.covariance = odometry.twist.covariance = [
            0.001 if index % 7 == 0 else 0.0 for index in range(36)
        ]
        self.odometry.publish(odometry)
        imu = self.stamped(Imu(), "base_footprint")
        imu.angular_velocity.z = rate
        imu.angular_velocity_covariance = [0.0001, 0.0, 0.0, 0.0, 0.0001, 0.0, 0.0, 0.0, 0.0001]
        imu.orientation_covariance[0] = imu.linear_acceleration_covariance[0] = -1.0
        self.imu.publish(imu)
        if self.turn % SCAN_EVERY == 0:
            scan = self.stamped(LaserScan(), "base_footprint")
            scan.angle_min, scan.angle_increment = -math.pi, math.tau / BEAMS
            scan.range_min, scan.range_max = 0.1, 12.0
            scan.ranges = [math.inf] * BEAMS
            self.scan.publish(scan)

    def stamped(self, message: Any, frame: str) -> Any:
        message.header.stamp = self.get_clock().now().to_msg()
        message.header.frame_id = f"{self.prefix}/{frame}"
        return message


def main() -> None:
    """Run until it is told to end."""
    rclpy.init()
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(Base())


if __name__ == "__main__":
    main()
