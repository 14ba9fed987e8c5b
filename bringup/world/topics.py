"""One robot's side of the ROS graph: its sensors' publishers, its commands and what its filter says."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from geometry_msgs.msg import Twist as TwistMessage
from nav_msgs.msg import Odometry as OdometryMessage
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy, qos_profile_sensor_data
from sensor_msgs.msg import Imu, LaserScan
from std_msgs.msg import UInt32

from bringup.world import messages
from bringup.world.drive import STILL, Twist
from bringup.world.geometry import Pose, compose, relative, wrap
from bringup.world.inbox import Inbox
from bringup.world.inertial import Inertial
from bringup.world.lidar import Lidar, noisy
from bringup.world.model import TICKS_PER_SECOND, pose, twist, wheel_angles
from bringup.world.odometry import Odometry
from bringup.world.simulation import Simulation, in_force
from bringup.world.track import Recent, Trail

if TYPE_CHECKING:
    from rclpy.node import Node

    from bringup.world.settings import Settings

# Every how many ticks something is done; rates are exact in simulated time. The IMU speaks at every tick.
ODOMETRY_TICKS = TICKS_PER_SECOND // 50
SCAN_TICKS = TICKS_PER_SECOND // 10
CONTACTS_TICKS = TICKS_PER_SECOND
KEPT_TICKS = 5 * TICKS_PER_SECOND

NEWEST = QoSProfile(depth=1)
NEWEST_OF_ANY = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
QUEUED = QoSProfile(depth=10)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


@dataclass(frozen=True, slots=True)
class FilterError:
    """How far the filter was from the truth (m, rad), at the tick its estimate was for."""

    tick: float
    distance: float
    turn: float


class RobotTopics:
    """Everything that one robot says and hears. Topics are relative to the node's namespace."""

    def __init__(self, node: Node, simulation: Simulation, number: int, settings: Settings) -> None:
        self.robot = simulation.model.robots[number]
        self.nearest = math.inf
        self.filter_error: FilterError | None = None
        self.true_trail, self.odometry_trail, self.filtered_trail = Trail(), Trail(), Trail()
        self._simulation = simulation
        self._contacts = simulation.contacts[number]
        self._settings = settings
        # A stream of chance for each sensor: none depends on how often another one speaks.
        seeds = np.random.SeedSequence([settings.seed, number]).spawn(3)
        wheels, inertial, self._lidar_chance = map(np.random.default_rng, seeds)
        self._odometry = Odometry(settings.wheels, ODOMETRY_TICKS / TICKS_PER_SECOND, wheels)
        self._inertial = Inertial(settings.inertial, inertial)
        self._lidar = Lidar(simulation.model, self.robot)
        self._recent = Recent(KEPT_TICKS)
        self._recent.add(Pose(0.0, 0.0, 0.0))
        self._command, self._command_tick = STILL, 0
        self._told_contacts = -1
        self._make_messages()
        self._open(node)

    def command(self) -> Twist:
        """The velocity command that is in force at the tick to come."""
        message = self._commands.newest()
        if message is not None:
            self._command = Twist(message.linear.x, message.angular.z)
            self._command_tick = self._simulation.ticks
        return in_force(self._command, self._simulation.ticks - self._command_tick)

    def publish(self) -> None:
        """Publish what is due at this tick."""
        ticks = self._simulation.ticks
        here = pose(self._simulation.data, self.robot)
        local = relative(self.robot.start, here)
        self._recent.add(local)
        self._publish_imu(ticks)
        if ticks % ODOMETRY_TICKS == 0:
            self._publish_truth(ticks, here, local)
            self._publish_odometry(ticks)
        if ticks % SCAN_TICKS == 0:
            self._publish_scan(ticks)
            self._hear_filter()
            self.true_trail.add(here.x, here.y)
        if ticks % CONTACTS_TICKS == 0 or self._contacts.episodes != self._told_contacts:
            self._publish_contacts()

    def _make_messages(self) -> None:
        name = self.robot.name
        self._truth_message = messages.new_odometry(name)
        self._odometry_message = messages.new_wheel_odometry(name)
        self._imu_message = messages.new_imu(name, self._settings.inertial)
        self._scan_message = messages.new_scan(name)

    def _open(self, node: Node) -> None:
        name = self.robot.name
        self._truth = node.create_publisher(OdometryMessage, f"{name}/ground_truth", QUEUED)
        self._wheel = node.create_publisher(OdometryMessage, f"{name}/wheel/odometry", QUEUED)
        self._imu = node.create_publisher(Imu, f"{name}/imu/data", QUEUED)
        self._scan = node.create_publisher(LaserScan, f"{name}/scan", qos_profile_sensor_data)
        self._contact_count = node.create_publisher(UInt32, f"{name}/contacts", LATCHED)
        self._commands = Inbox(node, TwistMessage, f"{name}/cmd_vel", NEWEST)
        self._filtered = Inbox(node, OdometryMessage, f"{name}/odometry/filtered", NEWEST_OF_ANY)

    def _publish_imu(self, ticks: int) -> None:
        messages.stamp(self._imu_message.header.stamp, ticks)
        true = self._simulation.data.sensordata[self.robot.imu]
        messages.fill_imu(self._imu_message, self._inertial.measure(true))
        self._imu.publish(self._imu_message)

    def _publish_truth(self, ticks: int, here: Pose, local: Pose) -> None:
        motion, sideways = twist(self._simulation.data, self.robot, here.yaw)
        messages.stamp(self._truth_message.header.stamp, ticks)
        messages.fill_motion(self._truth_message, local, motion, sideways)
        self._truth.publish(self._truth_message)

    def _publish_odometry(self, ticks: int) -> None:
        estimate = self._odometry.update(wheel_angles(self._simulation.data, self.robot))
        messages.stamp(self._odometry_message.header.stamp, ticks)
        messages.fill_motion(self._odometry_message, estimate.pose, estimate.twist)
        messages.fill_covariances(self._odometry_message, estimate.pose_covariance, estimate.twist_covariance)
        self._wheel.publish(self._odometry_message)
        if ticks % SCAN_TICKS == 0:
            believed = compose(self.robot.start, estimate.pose)
            self.odometry_trail.add(believed.x, believed.y)

    def _publish_scan(self, ticks: int) -> None:
        true = self._lidar.measure(self._simulation.data)
        self.nearest = float(true.min())
        messages.stamp(self._scan_message.header.stamp, ticks)
        messages.fill_scan(self._scan_message, noisy(true, self._settings.lidar_noise, self._lidar_chance))
        self._scan.publish(self._scan_message)

    def _publish_contacts(self) -> None:
        self._told_contacts = self._contacts.episodes
        self._contact_count.publish(UInt32(data=self._told_contacts))

    def _hear_filter(self) -> None:
        message = self._filtered.newest()
        if message is None:
            return
        estimate, tick = messages.pose_of(message), messages.ticks_of(message.header.stamp)
        believed = compose(self.robot.start, estimate)
        self.filtered_trail.add(believed.x, believed.y)
        true = self._recent.at(tick)
        if true is not None:
            apart = math.hypot(estimate.x - true.x, estimate.y - true.y)
            self.filter_error = FilterError(tick, apart, abs(wrap(estimate.yaw - true.yaw)))
