"""Topics, services and the action of the velocity controller.

Subscribes `scan` and `odometry/filtered`, publishes `cmd_vel` (Twist, or TwistStamped), `/diagnostics` and, latched,
`~/mode`. The mode is changed by the parameter `mode`, by one service per mode (`~/linear`, `~/rotational`, `~/wander`,
`~/hold`) or by `switch_mode`, which goes to the next; all of them are std_srvs/Trigger and answer with the mode's
name. A goal of the action `go_to_goal` changes it as well.
"""

from __future__ import annotations

import zlib
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from nav_msgs.msg import Odometry as OdometryMessage
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String
from std_srvs.srv import Trigger

from bringup.control import track
from bringup.control.command import STANDSTILL, Command
from bringup.control.controller import Odometry, Sight, State, ended, ticked
from bringup.control.journey import Journey
from bringup.control.modes import SIMPLE, Mode, following
from bringup.control.sight import clear_points, obstacle_points
from bringup.control_node.diagnostics import OK, Diagnostics
from bringup.control_node.goals import Goals
from bringup.control_node.health import health, values
from bringup.control_node.messages import fill_command, pose_of, seconds, twist_type
from bringup.control_node.taking import TAKEN_WHEN_NEEDED

if TYPE_CHECKING:
    from rclpy.node import Node

    from bringup.control.settings import Settings
    from bringup.control_node.parameters import Parameters

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


class VelocityController:
    """Everything of the controller that is on the graph, but for its parameters."""

    def __init__(self, node: Node, parameters: Parameters) -> None:
        self._node = node
        self._parameters = parameters
        self._state = State()
        self._sight: Sight | None = None
        self._odometry: Odometry | None = None
        self._track = track.Track()
        self._frame, self._base = "", ""
        kind = twist_type(self._settings.use_stamped)
        self._command_message = kind()
        self._commands = node.create_publisher(kind, "cmd_vel", COMMANDS, event_callbacks=UNWATCHED)
        self._mode = node.create_publisher(String, "~/mode", LATCHED, event_callbacks=UNWATCHED)
        self._mode.publish(String(data=self._settings.mode))
        self._diagnostics = Diagnostics(node, "driving")
        self._goals = Goals(node)
        self._subscribe()
        self._services = [
            node.create_service(Trigger, f"~/{mode}", partial(self._serve, mode)) for mode in SIMPLE
        ]
        self._services.append(node.create_service(Trigger, "switch_mode", partial(self._serve, None)))
        parameters.changed = self._changed

    def _subscribe(self) -> None:
        self._scans = self._node.create_subscription(
            LaserScan, "scan", self._see, NEWEST, event_callbacks=UNWATCHED_INPUT
        )
        self._locations = self._node.create_subscription(
            OdometryMessage,
            "odometry/filtered",
            self._locate,
            NEWEST,
            callback_group=TAKEN_WHEN_NEEDED,
            event_callbacks=UNWATCHED_INPUT,
        )

    @property
    def _settings(self) -> Settings:
        return self._parameters.settings

    def tick(self) -> None:
        """Send the next command."""
        self._take_odometry()
        before, now = self._state, self._now()
        self._take_goal(now)
        # Robots with the same parameters must not make the same choices: they would meet at every corner.
        seed = zlib.crc32(f"{self._settings.seed}{self._node.get_fully_qualified_name()}".encode())
        settings = replace(self._settings, seed=seed)
        self._state = ticked(self._state, settings, now, self._sight, self._odometry)
        self._send(self._state.command)
        self._goals.tell(now, self._state.journey, self._odometry, self._frame)
        self._report(before)
        self._diagnose(now)

    def stand_still(self, reason: str) -> None:
        """Send a last order to stand still, and wait a moment until it has arrived; goals end for that reason."""
        self._goals.end(reason)
        self._state = State()
        self._send(STANDSTILL)
        self._commands.wait_for_all_acked(FAREWELL)

    def stay(self) -> None:
        """Order to stand still, and take no goals."""
        self._goals.end("the controller is not active")
        self._send(STANDSTILL)
        now = self._now()
        if self._diagnostics.is_due(now, OK):
            self._diagnostics.tell(now, OK, "not active", {"mode": self._settings.mode})

    def close(self) -> None:
        """Leave the graph."""
        self._parameters.changed = None
        self._goals.close()
        self._diagnostics.close(self._node)
        for service in self._services:
            self._node.destroy_service(service)
        for subscription in (self._scans, self._locations):
            self._node.destroy_subscription(subscription)
        for publisher in (self._commands, self._mode):
            self._node.destroy_publisher(publisher)

    def _now(self) -> float:
        return float(self._node.get_clock().now().nanoseconds) * 1e-9

    def _take_goal(self, now: float) -> None:
        called_off = self._goals.called_off
        if called_off is not None:
            self._state = ended(self._state, called_off.outcome, called_off.text)
        goal = self._goals.due(self._settings, self._odometry, self._frame)
        if goal is None:
            return
        self._state = replace(self._state, journey=Journey(goal, now))
        if self._settings.mode != Mode.GO_TO_GOAL:
            self._set_mode(Mode.GO_TO_GOAL)
        self._node.get_logger().info(f"goal: x {goal.x:.2f}, y {goal.y:.2f} in {self._frame}")

    def _send(self, command: Command) -> None:
        stamp = self._node.get_clock().now().to_msg()
        fill_command(self._command_message, command, stamp, self._base)
        self._commands.publish(self._command_message)

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

    def _diagnose(self, now: float) -> None:
        level, text = health(self._state, self._settings)
        if self._diagnostics.is_due(now, level):
            self._diagnostics.tell(
                now, level, text, values(self._state, self._settings, now, self._sight, self._odometry)
            )

    def _see(self, scan: LaserScan) -> None:
        geometry = (
            (scan.angle_min, scan.angle_increment),
            (scan.range_min, scan.range_max),
            self._settings.lidar_x,
        )
        points = obstacle_points(scan.ranges, *geometry)
        # A scan that cannot be trusted is none: the last good one ages until it is too old to drive by.
        if points is not None:
            self._take_odometry()
            at = self._made_at(scan.header.stamp, self._settings.scan_timeout)
            pose = track.at(self._track, at)
            self._sight = Sight(at, points, pose, clear_points(scan.ranges, *geometry))

    def _made_at(self, stamp: Any, timeout: float) -> float:  # noqa: ANN401 - a message
        """When a message was made: its stamp, if that makes sense, else now."""
        now, stamped = self._now(), seconds(stamp)
        return stamped if 0.0 <= now - stamped <= timeout else now

    def _take_odometry(self) -> None:
        handle = self._locations.handle
        with handle:
            taken = handle.take_message(OdometryMessage, False)
        if taken is not None:
            self._locate(*taken)

    def _locate(self, message: OdometryMessage, info: dict[str, Any]) -> None:
        pose = pose_of(message.pose.pose)
        if pose is not None:
            at = self._made_at(message.header.stamp, self._settings.odometry_timeout)
            self._odometry = Odometry(at, pose, info["publication_sequence_number"] or 0)
            self._track = track.extended(self._track, at, pose)
            self._frame, self._base = message.header.frame_id, message.child_frame_id

    def _serve(self, mode: Mode | None, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        wanted = following(Mode(self._settings.mode)) if mode is None else mode
        response.success, reason = self._set_mode(wanted)
        response.message = reason or wanted.value
        return response

    def _set_mode(self, mode: Mode) -> tuple[bool, str]:
        result = self._node.set_parameters([Parameter("mode", value=mode.value)])[0]
        return result.successful, result.reason

    def _changed(self, before: Settings) -> None:
        if self._settings.mode != before.mode:
            self._mode.publish(String(data=self._settings.mode))
            self._node.get_logger().info(f"mode {self._settings.mode}")
