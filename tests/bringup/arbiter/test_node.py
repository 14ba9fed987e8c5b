"""The arbiter for real: who drives is what the base hears."""

import math
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist, TwistStamped
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Bool, String

import bringup
from tests.bringup.greeting import greeting
from tests.killing import kill

# What rclpy imports to find its types still uses the old name of a standard module.
pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")

DOMAIN = 47
DEADLINE = 40.0
TICK = 0.02
PARAMETERS = Path(bringup.__file__).parent / "params" / "command_arbiter.yaml"
NODE = "/robot1/command_arbiter"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Base:
    """What is around the arbiter: a clock, whoever wants to drive, and the base that hears who does."""

    def __init__(self, process: "subprocess.Popen[str]", kind: Any = Twist) -> None:
        self.process = process
        self.kind = kind
        self.context = rclpy.Context()
        rclpy.init(context=self.context, domain_id=DOMAIN)
        self.node = rclpy.create_node("base", context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.clock = self.node.create_publisher(Clock, "/clock", 10)
        self.autonomy = self.node.create_publisher(kind, "/robot1/cmd_vel_autonomy", 1)
        self.teleoperation = self.node.create_publisher(kind, "/robot1/cmd_vel_teleop", 1)
        self.stop = self.node.create_publisher(Bool, "/robot1/emergency_stop", LATCHED)
        self.commands: list[Any] = []
        self.active: list[str] = []
        self.health: dict[str, Any] = {}
        self.node.create_subscription(kind, "/robot1/cmd_vel", self.commands.append, 100)
        self.node.create_subscription(
            String, f"{NODE}/active", lambda message: self.active.append(message.data), LATCHED
        )
        self.node.create_subscription(DiagnosticArray, "/diagnostics", self._diagnosed, 10)
        self.tick = 0
        self.speeds: dict[Any, float] = {}

    def _diagnosed(self, message: DiagnosticArray) -> None:
        self.health |= {status.name: status for status in message.status}

    def close(self) -> None:
        self.executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self.context)

    def until(self, condition: Callable[[], bool], what: str) -> None:
        """Let time pass, whoever drives saying so at every tick, until the condition holds."""
        end = time.monotonic() + DEADLINE
        while not condition():
            assert time.monotonic() < end, f"not within {DEADLINE} s: {what}"
            assert self.process.poll() is None, f"the arbiter ended instead of: {what}"
            self.tick += 1
            now = Clock()
            now.clock.sec, now.clock.nanosec = divmod(self.tick * 20_000_000, 1_000_000_000)
            self.clock.publish(now)
            for publisher, speed in self.speeds.items():
                publisher.publish(self._command(speed))
            self.executor.spin_once(timeout_sec=0.005)

    def _command(self, speed: float) -> Any:
        message = self.kind()
        twist = message.twist if self.kind is TwistStamped else message
        twist.linear.x = speed
        return message

    def drives(self, speed: float) -> Callable[[], bool]:
        def condition() -> bool:
            last = self.commands[-1] if self.commands else None
            twist = last.twist if isinstance(last, TwistStamped) else last
            return twist is not None and bool(twist.linear.x == speed)

        return condition

    def is_told(self, text: str, level: bytes) -> Callable[[], bool]:
        def condition() -> bool:
            status = self.health.get("robot1/command_arbiter: commands")
            return status is not None and (status.message, status.level) == (text, level)

        return condition

    def in_force(self, name: str) -> Callable[[], bool]:
        return lambda: bool(self.active) and self.active[-1] == name

    def set(self, name: str, value: float) -> tuple[bool, str]:
        client = self.node.create_client(SetParameters, f"{NODE}/set_parameters")
        self.until(client.service_is_ready, "parameters can be set")
        with greeting(self.node, NODE) as known:
            self.until(known, "the arbiter knows its client")
        wanted = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value)
        answer = client.call_async(SetParameters.Request(parameters=[Parameter(name=name, value=wanted)]))
        self.until(answer.done, "the parameter is answered")
        self.node.destroy_client(client)
        [result] = answer.result().results
        return result.successful, result.reason


@contextmanager
def arbiter(*arguments: str) -> Iterator["subprocess.Popen[str]"]:
    process = subprocess.Popen(
        [
            *(sys.executable, "-m", "bringup.nodes.command_arbiter", "--ros-args", "-r", "__ns:=/robot1"),
            # After the file, whose more special section would win over a first `-p` before it.
            *(*arguments, "-p", "use_sim_time:=true"),
        ],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"ROS_DOMAIN_ID": str(DOMAIN)},
    )
    try:
        yield process
    finally:
        kill(process)
        process.communicate()


@contextmanager
def base(*arguments: str, kind: Any = Twist) -> Iterator[Base]:
    with arbiter("--params-file", str(PARAMETERS), *arguments) as process:
        made = Base(process, kind)
        try:
            made.until(lambda: bool(made.commands and made.active), "the arbiter talks")
            yield made
        finally:
            made.close()


@pytest.fixture(autouse=True, scope="module")
def _localhost() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        yield


def test_teleoperation_drives_over_autonomy_and_a_lock_stops_both() -> None:
    with base() as here:
        here.until(here.in_force("none"), "nobody is in force")
        here.until(here.drives(0.0), "nobody drives")
        here.speeds[here.autonomy] = 0.25
        here.until(here.drives(0.25), "autonomy drives")
        here.speeds[here.teleoperation] = 0.5
        here.until(here.in_force("teleoperation"), "teleoperation is in force")
        here.until(here.drives(0.5), "teleoperation drives")
        del here.commands[:]
        here.until(lambda: len(here.commands) > 20, "20 commands")
        assert all(command.linear.x == 0.5 for command in here.commands)
        here.stop.publish(Bool(data=True))
        here.until(here.in_force("emergency_stop"), "the lock holds")
        here.until(here.drives(0.0), "the robot is stopped")
        here.until(here.is_told("locked by emergency_stop", b"\x01"), "the lock is diagnosed")
        here.stop.publish(Bool(data=False))
        here.until(here.drives(0.5), "teleoperation drives again")
        del here.speeds[here.teleoperation]
        here.until(here.in_force("autonomy"), "autonomy is in force again")
        here.until(here.drives(0.25), "autonomy drives again")
        del here.speeds[here.autonomy]
        here.until(here.drives(0.0), "nobody drives")
        here.until(here.in_force("none"), "nobody is in force")
        told = {each.key: each.value for each in here.health["robot1/command_arbiter: commands"].values}
        assert told["lock emergency_stop"] == "priority 255, free"
        _end(here)


def test_what_is_no_number_is_not_passed_on_and_time_outs_can_be_changed() -> None:
    with base("-p", "topics.teleoperation.timeout:=1") as here:
        here.speeds[here.autonomy] = math.nan
        here.until(here.is_told("no numbers come from autonomy", b"\x02"), "the fault is diagnosed")
        assert here.drives(0.0)()
        here.speeds[here.autonomy] = 0.25
        here.until(here.drives(0.25), "autonomy drives")
        assert here.set("topics.autonomy.timeout", 0.0) == (
            False,
            "topics.autonomy.timeout is 0, must be more than 0",
        )
        assert here.set("topics.autonomy.timeout", 5.0) == (True, "")
        here.speeds.clear()
        silent = here.tick
        here.until(here.in_force("none"), "nobody is in force")
        assert (here.tick - silent) * TICK > 4.5


def test_a_lock_that_is_latched_is_heard_by_an_arbiter_that_starts_later_and_twists_may_be_stamped() -> None:
    with arbiter("--params-file", str(PARAMETERS), "-p", "use_stamped:=true") as process:
        here = Base(process, TwistStamped)
        try:
            here.stop.publish(Bool(data=True))
            here.until(here.in_force("emergency_stop"), "the lock holds")
            here.speeds[here.autonomy] = 0.25
            here.until(here.drives(0.0), "the robot is held")
            here.stop.publish(Bool(data=False))
            here.until(here.drives(0.25), "autonomy drives")
        finally:
            here.close()


def _end(here: Base) -> None:
    """The arbiter ends as a user ends it, with a last order to stand."""
    here.process.send_signal(signal.SIGINT)
    _, errors = here.process.communicate(timeout=DEADLINE)
    assert here.process.returncode == 0
    assert "Traceback" not in errors


def test_without_an_input_it_does_not_start() -> None:
    with arbiter() as process:
        _, errors = process.communicate(timeout=DEADLINE)
    assert process.returncode == 1
    assert "no input: give topics.NAME.topic" in errors
