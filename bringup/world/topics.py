"""One robot's side of the ROS graph: its sensors' publishers, its commands and what its filter says."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from geometry_msgs.msg import Twist as TwistMessage
from nav_msgs.msg import Odometry as OdometryMessage
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy, qos_profile_sensor_data
from std_msgs.msg import String, UInt32

from bringup.world import messages
from bringup.world.description import JOINTS, describe
from bringup.world.drive import STILL, Twist
from bringup.world.geometry import Pose, compose, wrap
from bringup.world.inbox import Inbox
from bringup.world.model import TICKS_PER_SECOND, wheel_angles, wheel_speeds
from bringup.world.sensing import Asked, Readings, Sensors, due, travelled
from bringup.world.simulation import TICK, Simulation, in_force
from bringup.world.spoken import InertialOut, JointsOut, OdometryOut, ScanOut
from bringup.world.track import Recent, Trail

if TYPE_CHECKING:
    from rclpy.node import Node

    from bringup.world.model import Moment
    from bringup.world.settings import RobotSettings, Settings

# What happens so often in a simulated second. The trails have a point at each of a trail's ticks.
JOINTS_RATE = 20.0
TRAIL_TICKS = TICKS_PER_SECOND // 10
CONTACTS_TICKS = TICKS_PER_SECOND
KEPT_TICKS = 5 * TICKS_PER_SECOND

NEWEST = QoSProfile(depth=1)
NEWEST_OF_ANY = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
ALL = QoSProfile(history=HistoryPolicy.KEEP_ALL)
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
        self._simulation = simulation
        self._contacts = simulation.contacts[number]
        self.sensors = Sensors(simulation, number, settings.each[number], settings.seed)
        self._open(node, settings, number)
        self.reset(settings.each[number])

    def reset(self, settings: RobotSettings) -> None:
        """Begin anew, as at the first tick."""
        self.filter_error: FilterError | None = None
        self.estimated: float | None = None
        self._given_up = False
        self.true_trail, self.odometry_trail, self.filtered_trail = Trail(), Trail(), Trail()
        self.sensors.reset(settings)
        self._recent = Recent(KEPT_TICKS, partial(travelled, robot=self.robot))
        self._recent.add(self._simulation.moment())
        self._believed = Pose(0.0, 0.0, 0.0)
        self._command, self._command_tick = STILL, -1
        self._told_contacts = -1

    def notice(self) -> None:
        """See which of the topics anybody listens to: on the others nothing is said until the next look."""
        self._asked = Asked(self._truth.wire.heard, self._imu.wire.heard, self._scan.wire.heard)
        self._wheel_heard, self._joints_heard = self._wheel.wire.heard, self._joints.wire.heard

    def hear(self) -> None:
        """Take the newest command that has come."""
        message = self._commands.newest()
        if message is not None:
            self._obey(message)

    def command(self) -> Twist:
        """The velocity command that is in force at the tick to come."""
        age = (self._simulation.ticks - self._command_tick) * TICK
        return in_force(self._command, age, self.sensors.settings.command_timeout)

    def next_command(self) -> bool:
        """Take the next command in the order in which they came; False if there is none yet."""
        message = self._commands.oldest()
        if message is not None:
            self._obey(message)
        return message is not None

    @property
    def told_at(self) -> int:
        """The tick before which the last command was taken; -1 before any."""
        return self._command_tick

    @property
    def last_command(self) -> Twist:
        """The last command that was taken, whatever its age."""
        return self._command

    def lagging(self, ticks: float) -> bool:
        """Whether this robot's newest estimate is for more than so many ticks ago; False if it has never had one."""
        now = self._simulation.ticks
        if self._given_up or self.estimated is None or now - self.estimated <= ticks:
            return False
        self._hear_filter()
        return now - self.estimated > ticks

    def give_up(self) -> None:
        """Expect no estimates any more."""
        self._given_up = True

    def looks(self, ticks: int) -> bool:
        """Whether this tick has to be published while the world still stands at it."""
        return self.sensors.looks(ticks, self._asked) or self._contacts.episodes != self._told_contacts

    def publish(self, ticks: int, now: Moment) -> None:
        """Publish what is due at a tick."""
        settings, readings = self.sensors.settings, self.sensors.read_at(ticks, now, self._asked)
        if readings.inertial is not None:
            self._imu.publish(ticks, readings.inertial)
        self._publish_motion(ticks, readings)
        if readings.ranges is not None:
            self._scan.publish(ticks, readings.ranges, settings.scan_rate, settings.lidar)
        if ticks % TRAIL_TICKS == 0:
            self._hear_filter()
            here = readings.world
            self.true_trail.add(here.x, here.y)
            believed = compose(self.robot.start, self._believed)
            self.odometry_trail.add(believed.x, believed.y)
        if self._joints_heard and due(ticks, JOINTS_RATE):
            self._joints.publish(ticks, wheel_angles(now, self.robot), wheel_speeds(now, self.robot))
        # Of several ticks in a row the last is the one at which a robot has touched something.
        touched = ticks == self._simulation.ticks and self._contacts.episodes != self._told_contacts
        if touched or ticks % CONTACTS_TICKS == 0:
            self._publish_contacts()

    def _open(self, node: Node, settings: Settings, number: int) -> None:
        name = self.robot.name
        self._truth = OdometryOut(node, f"{name}/ground_truth", messages.new_odometry(name), QUEUED)
        self._wheel = OdometryOut(node, f"{name}/wheel/odometry", messages.new_wheel_odometry(name), QUEUED)
        imu = messages.new_imu(name, self.sensors.settings.inertial)
        self._imu = InertialOut(node, f"{name}/imu/data", imu, QUEUED)
        self._scan = ScanOut(node, f"{name}/scan", messages.new_scan(name), qos_profile_sensor_data)
        joints = [f"{name}/{joint}" for joint in JOINTS]
        self._joints = JointsOut(node, f"{name}/joint_states", joints, QUEUED)
        self._contact_count = node.create_publisher(UInt32, f"{name}/contacts", LATCHED)
        self._description = node.create_publisher(String, f"{name}/robot_description", LATCHED)
        self._description.publish(String(data=describe(self._simulation.model, number)))
        commands = NEWEST if settings.lockstep_ticks is None else ALL
        self._commands = Inbox(node, TwistMessage, f"{name}/cmd_vel", commands)
        self._filtered = Inbox(node, OdometryMessage, f"{name}/odometry/filtered", NEWEST_OF_ANY)

    def _obey(self, message: TwistMessage) -> None:
        self._command = Twist(message.linear.x, message.angular.z)
        self._command_tick = self._simulation.ticks

    def _publish_motion(self, ticks: int, readings: Readings) -> None:
        self._recent.add(readings.moment)
        if readings.truth is not None:
            self._truth.publish_truth(ticks, readings.truth)
        if readings.odometry is not None:
            self._believed = readings.odometry.pose
        if readings.odometry is not None and self._wheel_heard:
            self._wheel.publish_estimate(ticks, readings.odometry)

    def _publish_contacts(self) -> None:
        self._told_contacts = self._contacts.episodes
        self._contact_count.publish(UInt32(data=self._told_contacts))

    def _hear_filter(self) -> None:
        message = self._filtered.newest()
        if message is None:
            return
        estimate, tick = messages.pose_of(message), messages.ticks_of(message.header.stamp)
        self.estimated = tick
        believed = compose(self.robot.start, estimate)
        self.filtered_trail.add(believed.x, believed.y)
        true = self._recent.at(tick)
        if true is not None:
            apart = math.hypot(estimate.x - true.x, estimate.y - true.y)
            self.filter_error = FilterError(tick, apart, abs(wrap(estimate.yaw - true.yaw)))
