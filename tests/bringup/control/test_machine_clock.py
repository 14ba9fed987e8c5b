"""The node for real on the machine's clock, where no clock message wakes it when the sensors fall silent."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import pytest
import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import LaserScan

from bringup.control_node.run import longest_wait
from tests.killing import kill

# What rclpy imports to find its types still uses the old name of a standard module.
pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")

DEADLINE = 40.0
DOMAIN = 43
# Enough for the timeouts (0.5 s and 1 s), the braking and a machine that has much else to do.
STOPPED_WITHIN = 10.0
PERIOD = 0.05


class Robot:
    """The controller's process, and everything around it: a lidar, odometry, and ears for what it sends."""

    def __init__(self, process: "subprocess.Popen[str]") -> None:
        self.process = process
        self.context = rclpy.Context()
        rclpy.init(context=self.context, domain_id=DOMAIN)
        self.node = rclpy.create_node("robot", context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        sensor = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        self.scan = self.node.create_publisher(LaserScan, "scan", sensor)
        self.odometry = self.node.create_publisher(Odometry, "odometry/filtered", 1)
        self.commands: list[Twist] = []
        self.node.create_subscription(Twist, "cmd_vel", self.commands.append, 100)
        self.silent: set[str] = {"scan", "odometry"}
        self._sent = 0.0

    def close(self) -> None:
        self.executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self.context)

    def until(self, condition: Callable[[], bool], what: str, within: float = DEADLINE) -> None:
        """Let the sensors that are not silent send until the condition holds."""
        end = time.monotonic() + within
        while not condition():
            assert time.monotonic() < end, f"not within {within} s: {what}"
            assert self.process.poll() is None, f"the controller ended instead of: {what}"
            if time.monotonic() - self._sent >= PERIOD:
                self._sent = time.monotonic()
                self._send()
            self.executor.spin_once(timeout_sec=0.01)

    def _send(self) -> None:
        if "odometry" not in self.silent:
            self.odometry.publish(Odometry())
        if "scan" not in self.silent:
            scan = LaserScan(
                range_min=0.12, range_max=12.0, angle_min=-3.14159265, angle_increment=0.0174532925
            )
            scan.ranges = [float("inf")] * 360
            self.scan.publish(scan)

    def end(self) -> str:
        """End the controller as a user does; gives what it has logged."""
        self.process.send_signal(signal.SIGINT)
        _, errors = self.process.communicate(timeout=DEADLINE)
        assert self.process.returncode == 0
        return errors


@contextmanager
def robot(*parameters: str) -> Iterator[Robot]:
    given = [word for parameter in parameters for word in ("-p", parameter)]
    process = subprocess.Popen(
        [sys.executable, "-m", "bringup.nodes.velocity_controller", "--ros-args", *given],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"ROS_DOMAIN_ID": str(DOMAIN)},
    )
    try:
        surroundings = Robot(process)
        try:
            yield surroundings
        finally:
            surroundings.close()
    finally:
        kill(process)
        process.communicate()


@pytest.fixture(autouse=True, scope="module")
def _localhost() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        yield


@pytest.mark.parametrize(
    ("silent", "warning"),
    [
        ({"scan", "odometry"}, "standing still: no scan for 0.5 s"),
        ({"scan"}, "standing still: no scan for 0.5 s"),
        ({"odometry"}, "standing still: no odometry for 1.0 s"),
    ],
)
def test_it_never_drives_blind(silent: set[str], warning: str) -> None:
    with robot("mode:=linear", "odometry_timeout:=1.0") as here:
        here.silent = set()
        here.until(lambda: bool(here.commands) and here.commands[-1].linear.x > 0.49, "driving")
        here.silent = silent
        here.until(lambda: here.commands[-1] == Twist(), "standing still", STOPPED_WITHIN)
        assert warning in here.end()


def test_without_sensors_it_orders_to_stand_10_times_a_second() -> None:
    with robot("mode:=linear") as here:
        here.until(lambda: bool(here.commands), "a command")
        first, began = len(here.commands), time.monotonic()
        here.until(lambda: len(here.commands) >= first + 30, "30 commands", 15.0)
        # The first ones may have come late, and then the others seem to come faster.
        assert time.monotonic() - began > 2.0
        assert all(command == Twist() for command in here.commands)
        assert "waiting: no usable scan" in here.end()


def test_a_parameter_that_it_does_not_have_is_warned_of() -> None:
    with robot("use_sim_time:=false", "max_linear_vell:=0.3", "mode:=hold") as here:
        here.until(lambda: bool(here.commands), "a command")
        told = [line for line in here.end().splitlines() if "unknown" in line]
    assert len(told) == 1
    assert told[0].endswith(
        "parameter max_linear_vell is unknown and has no effect; did you mean max_linear_vel?"
    )


@pytest.mark.parametrize(
    ("left", "nanoseconds"),
    [
        (None, -1),
        (0, 0),
        (20_000_000, 20_000_000),
        (100_000_000, 100_000_000),
        (3_600_000_000_000, 100_000_000),
    ],
)
def test_it_waits_for_a_tick_or_for_the_clock_and_never_long_for_a_clock_that_was_set_back(
    left: int | None, nanoseconds: int
) -> None:
    assert longest_wait(left) == nanoseconds
