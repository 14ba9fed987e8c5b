"""The velocity controller: drives one robot and stops before obstacles, at 10 Hz of ROS time.

Subscribes `scan` and `odometry/filtered`, publishes `cmd_vel` and, latched, `~/mode`. The mode is changed by
the parameter `mode`, by one service per mode (`~/linear`, `~/rotational`, `~/wander`, `~/hold`) or by
`switch_mode`, which goes to the next; all of them are std_srvs/Trigger and answer with the mode's name.

The signals are waited for in a thread instead of being handled: rclpy's own handler shuts the context down
at once, and then the last order to stand still could not be sent any more.
"""

from __future__ import annotations

import math
import os
import signal
import sys
import threading
import zlib
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

# The arrays are far too small for a thread pool; it must be said before numpy is imported.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry as OdometryMessage
from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor, SetParametersResult
from rclpy.duration import Duration
from rclpy.exceptions import InvalidParameterTypeException, InvalidParameterValueException
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String
from std_srvs.srv import Trigger

from bringup.control.command import STANDSTILL, Command, Pose
from bringup.control.controller import Odometry, Sight, State, ticked
from bringup.control.modes import Mode, following
from bringup.control.settings import Setting, Settings, objection, table
from bringup.control.sight import obstacle_points

if TYPE_CHECKING:
    from collections.abc import Sequence

PERIOD = 0.1
# How long the end waits until the last command has arrived.
FAREWELL = Duration(seconds=0.3)
ENDING = (signal.SIGINT, signal.SIGTERM)

NEWEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
COMMANDS = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE)
LATCHED = QoSProfile(
    depth=1, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL
)


class UnusableParametersError(Exception):
    """The node was started with parameters that do not go together."""


REFUSALS = (InvalidParameterTypeException, InvalidParameterValueException, UnusableParametersError)


class VelocityController(Node):
    """The node. Raises UnusableParametersError, or rclpy's own errors for a wrong type or range."""

    def __init__(self) -> None:
        super().__init__("velocity_controller")
        for each in table():
            self.declare_parameter(each.name, each.default, descriptor(each))
        self.settings = Settings(**{each.name: self.get_parameter(each.name).value for each in table()})
        reason = objection(self.settings)
        if reason is not None:
            raise UnusableParametersError(reason)
        self.state = State()
        self.sight: Sight | None = None
        self.odometry: Odometry | None = None
        self.add_on_set_parameters_callback(self._check)
        self.add_post_set_parameters_callback(self._apply)
        self._twist = Twist()
        self._commands = self.create_publisher(Twist, "cmd_vel", COMMANDS)
        self._mode = self.create_publisher(String, "~/mode", LATCHED)
        self._mode.publish(String(data=self.settings.mode))
        self.create_subscription(LaserScan, "scan", self._see, NEWEST)
        self.create_subscription(OdometryMessage, "odometry/filtered", self._locate, NEWEST)
        for mode in Mode:
            self.create_service(Trigger, f"~/{mode}", partial(self._serve, mode))
        self.create_service(Trigger, "switch_mode", partial(self._serve, None))
        self.create_timer(PERIOD, self._tick)

    def stand_still(self) -> None:
        """Send a last order to stand still, and wait a moment until it has arrived."""
        self._send(STANDSTILL)
        self._commands.wait_for_all_acked(FAREWELL)

    def _now(self) -> float:
        return float(self.get_clock().now().nanoseconds) * 1e-9

    def _tick(self) -> None:
        before = self.state
        # Robots with the same parameters must not make the same choices: they would meet at every corner.
        seed = zlib.crc32(f"{self.settings.seed}{self.get_fully_qualified_name()}".encode())
        settings = replace(self.settings, seed=seed)
        self.state = ticked(before, settings, self._now(), self.sight, self.odometry)
        self._send(self.state.command)
        self._report(before)

    def _send(self, command: Command) -> None:
        self._twist.linear.x = command.linear
        self._twist.angular.z = command.angular
        self._commands.publish(self._twist)

    def _report(self, before: State) -> None:
        fault = self.state.fault
        if fault == before.fault:
            return
        if fault is None:
            self.get_logger().info(f"driving: mode {self.settings.mode}")
        elif before.at is None:
            self.get_logger().info(f"waiting: {fault}")
        else:
            self.get_logger().warning(f"standing still: {fault}")

    def _see(self, scan: LaserScan) -> None:
        angles = scan.angle_min, scan.angle_increment
        points = obstacle_points(scan.ranges, angles, (scan.range_min, scan.range_max), self.settings.lidar_x)
        # A scan that cannot be trusted is none: the last good one ages until it is too old to drive by.
        if points is not None:
            self.sight = Sight(self._now(), points, self.odometry.pose if self.odometry else None)

    def _locate(self, message: OdometryMessage) -> None:
        position, turn = message.pose.pose.position, message.pose.pose.orientation
        yaw = math.atan2(
            2.0 * (turn.w * turn.z + turn.x * turn.y), 1.0 - 2.0 * (turn.y * turn.y + turn.z * turn.z)
        )
        if all(map(math.isfinite, (position.x, position.y, yaw))):
            self.odometry = Odometry(self._now(), Pose(position.x, position.y, yaw))

    def _serve(self, mode: Mode | None, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        wanted = following(Mode(self.settings.mode)) if mode is None else mode
        result = self.set_parameters([Parameter("mode", value=wanted.value)])[0]
        response.success = result.successful
        response.message = wanted.value if result.successful else result.reason
        return response

    def _check(self, parameters: Sequence[Parameter]) -> SetParametersResult:
        reason = objection(self._with(parameters))
        return SetParametersResult(successful=reason is None, reason=reason or "")

    def _apply(self, parameters: Sequence[Parameter]) -> None:
        before, self.settings = self.settings, self._with(parameters)
        if self.settings.mode != before.mode:
            self._mode.publish(String(data=self.settings.mode))
            self.get_logger().info(f"mode {self.settings.mode}")

    def _with(self, parameters: Sequence[Parameter]) -> Settings:
        ours = {each.name for each in table()}
        return replace(self.settings, **{each.name: each.value for each in parameters if each.name in ours})


def descriptor(setting: Setting) -> ParameterDescriptor:
    """The parameter's descriptor as ROS wants it."""
    described = ParameterDescriptor(
        description=setting.description, additional_constraints=setting.constraints
    )
    if isinstance(setting.default, float):
        described.floating_point_range = [
            FloatingPointRange(from_value=setting.minimum, to_value=setting.maximum, step=0.0)
        ]
    elif isinstance(setting.default, int):
        described.integer_range = [IntegerRange(from_value=setting.minimum, to_value=setting.maximum, step=1)]
    return described


def main(args: list[str] | None = None) -> int:
    """Run the node until SIGINT or SIGTERM; the exit status, 1 if its parameters cannot be used."""
    signal.pthread_sigmask(signal.SIG_BLOCK, ENDING)
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    try:
        _spin(VelocityController())
    except REFUSALS as error:
        sys.stderr.write(f"velocity_controller: {error}\n")
        return 1
    finally:
        rclpy.shutdown()
    return 0


def _spin(node: VelocityController) -> None:
    asked = Future()
    threading.Thread(target=lambda: asked.set_result(signal.sigwait(ENDING)), daemon=True).start()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        executor.spin_until_future_complete(asked)
        node.stand_still()
    finally:
        executor.shutdown()
        node.destroy_node()


if __name__ == "__main__":
    sys.exit(main())
