"""Everything about a velocity controller that is a process of its own: a clock, a lidar, odometry, ears."""

import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist, TwistStamped
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import GetParameters, SetParameters, SetParametersAtomically
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String

from tests.bringup.greeting import greeting
from tests.killing import kill

DEADLINE = 40.0
NODE = "/robot1/velocity_controller"
TICK = 0.02


class Bench:
    """Everything around the controller: a clock, a lidar, odometry, and ears for what it sends."""

    stamped = False

    def __init__(self, domain: int, process: "subprocess.Popen[str]") -> None:
        self.process = process
        self.context = rclpy.Context()
        rclpy.init(context=self.context, domain_id=domain)
        self.node = rclpy.create_node("bench", context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.clock = self.node.create_publisher(Clock, "/clock", 10)
        sensor = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.scan = self.node.create_publisher(LaserScan, "/robot1/scan", sensor)
        self.odometry = self.node.create_publisher(Odometry, "/robot1/odometry/filtered", 1)
        self.commands: list[Twist] = []
        self.modes: list[str] = []
        kind = TwistStamped if self.stamped else Twist
        self.node.create_subscription(kind, "/robot1/cmd_vel", self._hear, 100)
        self.health: dict[str, Any] = {}
        self.node.create_subscription(DiagnosticArray, "/diagnostics", self._diagnosed, 10)
        self.node.create_subscription(
            String, f"{NODE}/mode", lambda message: self.modes.append(message.data), latched
        )
        self.tick = 0
        self.ahead = float("inf")
        self.scanning = True
        self.locating = True

    def _hear(self, message: Any) -> None:
        self.commands.append(message.twist if self.stamped else message)

    def _diagnosed(self, message: DiagnosticArray) -> None:
        self.health |= {status.name: status for status in message.status}

    def is_told(self, level: bytes, text: str) -> Callable[[], bool]:
        """Whether the controller's last diagnosis says this."""

        def condition() -> bool:
            status = self.health.get("robot1/velocity_controller: driving")
            return status is not None and (status.level, status.message) == (level, text)

        return condition

    @property
    def time(self) -> float:
        return self.tick * TICK

    def close(self) -> None:
        self.executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self.context)

    def until(self, condition: Callable[[], bool], what: str, ticks: int = 1) -> None:
        """Let simulated time pass (0 ticks: stand), all sensors that are on sending, until the condition holds."""
        end = time.monotonic() + DEADLINE
        while not condition():
            assert time.monotonic() < end, f"not within {DEADLINE} s: {what}"
            assert self.process.poll() is None, f"the controller ended instead of: {what}"
            self._step(ticks)
            self.executor.spin_once(timeout_sec=0.005)

    def _step(self, ticks: int) -> None:
        self.tick += ticks
        now = Clock()
        now.clock.sec, now.clock.nanosec = divmod(self.tick * 20_000_000, 1_000_000_000)
        self.clock.publish(now)
        if self.locating:
            self.odometry.publish(self._odometry())
        if self.scanning and self.tick % 5 == 0:
            self.scan.publish(self._scan())

    def _odometry(self) -> Odometry:
        return Odometry()

    def _scan(self) -> LaserScan:
        scan = LaserScan(range_min=0.12, range_max=12.0, angle_min=-3.14159265, angle_increment=0.0174532925)
        scan.ranges = [float("inf")] * 360
        scan.ranges[175:186] = type(scan.ranges)("f", [self.ahead] * 11)
        return scan

    def call(self, kind: Any, name: str, request: Any, *, again: bool = True) -> Any:
        """Ask, and where it does no harm ask again: an answer that comes before both sides know each other is lost.

        Else they get to know each other first.
        """
        client = self.node.create_client(kind, name)
        asked: list[tuple[float, Any]] = []

        def answered() -> bool:
            if not asked or (again and time.monotonic() > asked[-1][0] + 5.0):
                asked.append((time.monotonic(), client.call_async(request)))
            return any(answer.done() for _, answer in asked)

        try:
            self.until(client.service_is_ready, f"{name} is there")
            if not again:
                self.greet()
            self.until(answered, f"{name} answers")
            return next(answer.result() for _, answer in asked if answer.done())
        finally:
            self.node.destroy_client(client)

    def greet(self) -> None:
        """Wait until the controller knows all clients that there are so far."""
        with greeting(self.node, NODE) as known:
            self.until(known, "the controller knows its clients")

    def set(self, atomically: bool = False, **values: Any) -> list[tuple[bool, str]]:
        wanted = [Parameter(name=name, value=value_of(value)) for name, value in values.items()]
        if atomically:
            request = SetParametersAtomically.Request(parameters=wanted)
            answer = self.call(SetParametersAtomically, f"{NODE}/set_parameters_atomically", request)
            return [(answer.result.successful, answer.result.reason)]
        answer = self.call(SetParameters, f"{NODE}/set_parameters", SetParameters.Request(parameters=wanted))
        return [(result.successful, result.reason) for result in answer.results]

    def get(self, *names: str) -> list[Any]:
        answer = self.call(GetParameters, f"{NODE}/get_parameters", GetParameters.Request(names=names))
        return [
            value.double_value if value.type == ParameterType.PARAMETER_DOUBLE else value.string_value
            for value in answer.values
        ]

    def drives(self, speed: float) -> Callable[[], bool]:
        return lambda: bool(self.commands) and abs(self.commands[-1].linear.x - speed) < 0.01


def value_of(value: Any) -> ParameterValue:
    if isinstance(value, bool):
        return ParameterValue(type=ParameterType.PARAMETER_BOOL, bool_value=value)
    if isinstance(value, str):
        return ParameterValue(type=ParameterType.PARAMETER_STRING, string_value=value)
    if isinstance(value, int):
        return ParameterValue(type=ParameterType.PARAMETER_INTEGER, integer_value=value)
    return ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value)


@contextmanager
def controller(
    domain: int, *parameters: str, executable: str = "velocity_controller"
) -> Iterator["subprocess.Popen[str]"]:
    arguments = ["--ros-args", "-r", "__ns:=/robot1"]
    for parameter in parameters:
        arguments += ["-p", parameter]
    process = subprocess.Popen(
        [sys.executable, "-m", f"bringup.nodes.{executable}", *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"ROS_DOMAIN_ID": str(domain)},
    )
    try:
        yield process
    finally:
        kill(process)
        process.communicate()


@contextmanager
def on_bench(
    domain: int, *parameters: str, kind: type[Bench] = Bench
) -> Iterator[tuple[Bench, "subprocess.Popen[str]"]]:
    with controller(domain, "use_sim_time:=true", *parameters) as process:
        bench = kind(domain, process)
        try:
            bench.until(lambda: bool(bench.commands and bench.modes), "the controller talks")
            yield bench, process
        finally:
            bench.close()
