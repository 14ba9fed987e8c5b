"""Topics and services of the velocity controller.

Subscribes `scan` and `odometry/filtered`, publishes `cmd_vel` and, latched, `~/mode`. The mode is changed by
the parameter `mode`, by one service per mode (`~/linear`, `~/rotational`, `~/wander`, `~/hold`) or by
`switch_mode`, which goes to the next; all of them are std_srvs/Trigger and answer with the mode's name.
"""

from __future__ import annotations

import math
import zlib
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry as OdometryMessage
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String
from std_srvs.srv import Trigger

from bringup.control.command import STANDSTILL, Command, Pose
from bringup.control.controller import Odometry, Sight, State, ticked
from bringup.control.modes import Mode, following
from bringup.control.sight import obstacle_points
from bringup.control_node.parameters import Parameters

if TYPE_CHECKING:
    from rclpy.node import Node

    from bringup.control.settings import Settings

# How long the end waits until the last command has arrived.
FAREWELL = Duration(seconds=0.5)
NEWEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
COMMANDS = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE)
LATCHED = QoSProfile(
    depth=1, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL
)
# The two events that rclpy adds to each topic end make every wake-up dearer, and only repeat the peer's warning.
UNWATCHED = PublisherEventCallbacks(use_default_callbacks=False)
UNWATCHED_INPUT = SubscriptionEventCallbacks(use_default_callbacks=False)


class TakenWhenNeeded(MutuallyExclusiveCallbackGroup):  # type: ignore[misc] # rclpy is untyped
    """A group that the executor never waits for: its messages stay with the middleware until they are taken."""

    def can_execute(self, entity: object) -> bool:  # noqa: ARG002 - the signature is rclpy's
        """Never."""
        return False


class VelocityController:
    """Everything of the controller that is on the graph. Raises what `Parameters` raises."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._parameters = Parameters(node, self._changed)
        self._state = State()
        self._sight: Sight | None = None
        self._odometry: Odometry | None = None
        self._twist = Twist()
        self._commands = node.create_publisher(Twist, "cmd_vel", COMMANDS, event_callbacks=UNWATCHED)
        self._mode = node.create_publisher(String, "~/mode", LATCHED, event_callbacks=UNWATCHED)
        self._mode.publish(String(data=self._settings.mode))
        node.create_subscription(LaserScan, "scan", self._see, NEWEST, event_callbacks=UNWATCHED_INPUT)
        self._locations = node.create_subscription(
            OdometryMessage,
            "odometry/filtered",
            self._locate,
            NEWEST,
            callback_group=TakenWhenNeeded(),
            event_callbacks=UNWATCHED_INPUT,
        )
        for mode in Mode:
            node.create_service(Trigger, f"~/{mode}", partial(self._serve, mode))
        node.create_service(Trigger, "switch_mode", partial(self._serve, None))

    @property
    def _settings(self) -> Settings:
        return self._parameters.settings

    def tick(self) -> None:
        """Send the next command."""
        self._take_odometry()
        before = self._state
        # Robots with the same parameters must not make the same choices: they would meet at every corner.
        seed = zlib.crc32(f"{self._settings.seed}{self._node.get_fully_qualified_name()}".encode())
        settings = replace(self._settings, seed=seed)
        self._state = ticked(before, settings, self._now(), self._sight, self._odometry)
        self._send(self._state.command)
        self._report(before)

    def stand_still(self) -> None:
        """Send a last order to stand still, and wait a moment until it has arrived."""
        self._send(STANDSTILL)
        self._commands.wait_for_all_acked(FAREWELL)

    def _now(self) -> float:
        return float(self._node.get_clock().now().nanoseconds) * 1e-9

    def _send(self, command: Command) -> None:
        self._twist.linear.x = command.linear
        self._twist.angular.z = command.angular
        self._commands.publish(self._twist)

    def _report(self, before: State) -> None:
        fault = self._state.fault
        if fault == before.fault:
            return
        if fault is None:
            self._node.get_logger().info(f"driving: mode {self._settings.mode}")
        elif before.fault is None and before.at is not None:
            self._node.get_logger().warning(f"standing still: {fault}")
        else:
            self._node.get_logger().info(f"waiting: {fault}")

    def _see(self, scan: LaserScan) -> None:
        angles = scan.angle_min, scan.angle_increment
        points = obstacle_points(
            scan.ranges, angles, (scan.range_min, scan.range_max), self._settings.lidar_x
        )
        # A scan that cannot be trusted is none: the last good one ages until it is too old to drive by.
        if points is not None:
            self._take_odometry()
            self._sight = Sight(
                self._taken_at(scan.header.stamp), points, self._odometry.pose if self._odometry else None
            )

    def _taken_at(self, stamp: object) -> float:
        """When a scan was taken: its stamp, if that makes sense, else now."""
        now = self._now()
        stamped = float(Time.from_msg(stamp).nanoseconds) * 1e-9
        return stamped if 0.0 <= now - stamped <= self._settings.scan_timeout else now

    def _take_odometry(self) -> None:
        handle = self._locations.handle
        with handle:
            taken = handle.take_message(OdometryMessage, False)
        if taken is not None:
            self._locate(taken[0])

    def _locate(self, message: OdometryMessage) -> None:
        position, turn = message.pose.pose.position, message.pose.pose.orientation
        yaw = math.atan2(
            2.0 * (turn.w * turn.z + turn.x * turn.y), 1.0 - 2.0 * (turn.y * turn.y + turn.z * turn.z)
        )
        if all(map(math.isfinite, (position.x, position.y, yaw))):
            self._odometry = Odometry(self._now(), Pose(position.x, position.y, yaw))

    def _serve(self, mode: Mode | None, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        wanted = following(Mode(self._settings.mode)) if mode is None else mode
        result = self._node.set_parameters([Parameter("mode", value=wanted.value)])[0]
        response.success = result.successful
        response.message = wanted.value if result.successful else result.reason
        return response

    def _changed(self, before: Settings) -> None:
        if self._settings.mode != before.mode:
            self._mode.publish(String(data=self._settings.mode))
            self._node.get_logger().info(f"mode {self._settings.mode}")
