"""The monitor for real: a process of its own, and another one that plays robots which come and go."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from typing import TYPE_CHECKING, Any

import pytest

from tests.bringup.greeting import greeting
from tests.killing import kill

pytest.importorskip("rclpy", reason="needs ROS")

import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from rcl_interfaces.srv import DescribeParameters, SetParameters
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String, UInt32

from bringup.fleet.settings import table
from bringup.fleet_node.interfaces import ClaimGoal, FleetSummary, ReleaseGoal
from orchestra.ros.interfaces import tf_message_type
from orchestra.testing.domain import free_domain

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

# What rclpy imports to find its types still uses the old name of a standard module.
pytestmark = [pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning"), pytest.mark.timeout(120)]

_PATIENCE = 60.0
_LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class _World:
    """Robots, each a node of the name that controllers have, and ears for the monitor."""

    def __init__(self, domain: int, monitor: subprocess.Popen[str]) -> None:
        self.monitor = monitor
        self.context = rclpy.Context()
        rclpy.init(context=self.context, domain_id=domain)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.node = self._node("bench")
        self.robots: dict[str, tuple[Any, Any]] = {}
        self.summary: dict[str, Any] = {}
        self.node.create_subscription(FleetSummary, "/fleet_monitor/summary", self._hear, _LATCHED)
        self.frames = self.node.create_publisher(tf_message_type(), "/tf_static", _LATCHED)
        self.diagnostics = self.node.create_publisher(DiagnosticArray, "/diagnostics", 10)

    def _node(self, name: str, namespace: str = "/") -> Any:
        node = rclpy.create_node(name, namespace=namespace, context=self.context)
        self.executor.add_node(node)
        return node

    def _hear(self, message: Any) -> None:
        self.summary = {each.name: each for each in message.robots}

    def come(self, robot: str) -> None:
        node = self._node("velocity_controller", f"/{robot}")
        node.create_publisher(String, "~/mode", _LATCHED).publish(String(data="wander"))
        node.create_publisher(UInt32, "contacts", _LATCHED).publish(UInt32(data=2))
        self.robots[robot] = (node, node.create_publisher(Odometry, "odometry/filtered", 10))

    def go(self, robot: str) -> None:
        node, _ = self.robots.pop(robot)
        self.executor.remove_node(node)
        node.destroy_node()

    def until(self, condition: Callable[[], bool], what: str) -> None:
        """Let the robots tell where they are until the condition holds."""
        end = time.monotonic() + _PATIENCE
        while not condition():
            assert time.monotonic() < end, f"not within {_PATIENCE} s: {what}; {self.summary}"
            assert self.monitor.poll() is None, f"the monitor ended instead of: {what}"
            for robot, (node, publisher) in self.robots.items():
                odometry = Odometry()
                odometry.header.frame_id = f"{robot}/odom"
                odometry.header.stamp = node.get_clock().now().to_msg()
                odometry.pose.pose.position.x = 1.0
                odometry.twist.twist.linear.x = 0.25
                publisher.publish(odometry)
            self.executor.spin_once(timeout_sec=0.02)

    def call(self, kind: Any, name: str, *asked: Any) -> list[Any]:
        """Ask several things at once."""
        client = self.node.create_client(kind, name)
        self.until(client.service_is_ready, f"{name} is there")
        with greeting(self.node, "/fleet_monitor") as known:
            self.until(known, "the monitor knows its client")
        answers = [client.call_async(each) for each in asked]
        self.until(lambda: all(each.done() for each in answers), f"{name} answers")
        self.node.destroy_client(client)
        return [each.result() for each in answers]

    def claim(self, *goals: tuple[str, float]) -> list[Any]:
        """Claim goals of robots, `x` in the odometry's frame of each."""
        requests = []
        for robot, x in goals:
            request = ClaimGoal.Request(robot=robot)
            request.goal.header.frame_id = f"{robot}/odom"
            request.goal.pose.position.x = x
            requests.append(request)
        return self.call(ClaimGoal, "/fleet_monitor/claim_goal", *requests)

    def stand(self, robot: str, x: float) -> TransformStamped:
        """Return where the frame of a robot stands in the world."""
        frame = TransformStamped()
        frame.header.frame_id, frame.child_frame_id = "world", f"{robot}/odom"
        frame.transform.translation.x = x
        return frame

    def close(self) -> None:
        self.executor.shutdown()
        for node in (*(node for node, _ in self.robots.values()), self.node):
            node.destroy_node()
        rclpy.shutdown(context=self.context)


@pytest.fixture
def world() -> Iterator[_World]:
    with free_domain(os.environ) as domain:
        environment = {
            **os.environ,
            "ROS_DOMAIN_ID": str(domain),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        }
        command = [sys.executable, "-m", "bringup.nodes.fleet_monitor", "--ros-args", "-p", "rate:=10.0"]
        command += ["-p", "gone_after:=0.5"]
        monitor = subprocess.Popen(command, env=environment, text=True)
        try:
            found = _World(domain, monitor)
            try:
                yield found
            finally:
                found.close()
            monitor.send_signal(signal.SIGINT)
            assert monitor.wait(_PATIENCE) == 0
        finally:
            kill(monitor)
            monitor.wait()


def test_robots_are_seen_and_two_of_them_never_drive_to_one_place(world: _World) -> None:
    """They come, are told of, claim, are refused what another holds, let go, are taken over, and go."""
    world.come("robot1")
    world.come("robot2")
    world.frames.publish(
        tf_message_type()(transforms=[world.stand("robot1", 0.0), world.stand("robot2", 5.0)])
    )
    world.until(
        lambda: [each.pose.header.frame_id for each in world.summary.values()] == ["world"] * 2,
        "both are seen, in the world",
    )
    world.until(lambda: all(each.mode == "wander" for each in world.summary.values()), "the modes are heard")
    world.until(lambda: all(each.contacts == 2 for each in world.summary.values()), "the contacts are heard")
    world.until(lambda: all(each.health == 0 for each in world.summary.values()), "the controllers are seen")
    for name, x in (("robot1", 1.0), ("robot2", 6.0)):
        assert world.summary[name].pose.pose.position.x == pytest.approx(x)
        assert world.summary[name].speed == 0.25
    # One place: robot1 sees it 5.1 m ahead, robot2 0.1 m. What comes together is decided by the names.
    second, first = world.claim(("robot2", 0.1), ("robot1", 5.1))
    assert (first.granted, second.granted) in ((True, False), (False, True))
    holder, other = ("robot1", "robot2") if first.granted else ("robot2", "robot1")
    refused = second if first.granted else first
    assert refused.holder == holder
    assert refused.distance == pytest.approx(0.0, abs=1e-6)
    world.until(lambda: world.summary[holder].has_goal, "the goal is told")
    (released,) = world.call(ReleaseGoal, "/fleet_monitor/release_goal", ReleaseGoal.Request(robot=holder))
    assert released.released
    places = {"robot1": 5.1, "robot2": 0.1}
    (granted,) = world.claim((other, places[other]))
    assert granted.granted
    world.until(lambda: world.summary[other].has_goal, "the other's goal is told")
    # Its controller ends and another one begins, which knows of no goal.
    world.go(other)
    world.come(other)
    world.until(lambda: other in world.summary and not world.summary[other].has_goal, "the claim ends")
    (granted,) = world.claim((holder, places[holder]))
    assert granted.granted
    world.go(holder)
    world.until(lambda: set(world.summary) == {other}, "a robot goes")
    (granted,) = world.claim((other, places[other]))
    assert granted.granted, granted.message
    (stranger,) = world.claim(("robot9", 0.0))
    assert "no robot 'robot9'" in stranger.message


def test_trouble_of_a_robot_is_told(world: _World) -> None:
    world.come("robot1")
    world.until(lambda: "robot1" in world.summary and world.summary["robot1"].health == 0, "it is well")
    status = DiagnosticStatus(name="/robot1/ekf: health", level=b"\x02", message="no IMU")

    def in_trouble() -> bool:
        world.diagnostics.publish(DiagnosticArray(status=[status]))
        return list(world.summary["robot1"].reasons) == ["ekf: health: no IMU"]

    world.until(in_trouble, "what diagnostics say is told")
    assert world.summary["robot1"].health == 2


def test_its_parameters_are_described_and_change_while_it_runs(world: _World) -> None:
    rate = Parameter("rate", value=20.0).to_parameter_msg()
    fixed = Parameter("odometry", value="odom").to_parameter_msg()
    too_much = Parameter("rate", value=1000.0).to_parameter_msg()
    (answer,) = world.call(
        SetParameters,
        "/fleet_monitor/set_parameters",
        SetParameters.Request(parameters=[rate, fixed, too_much]),
    )
    assert [each.successful for each in answer.results] == [True, False, False]
    (described,) = world.call(
        DescribeParameters,
        "/fleet_monitor/describe_parameters",
        DescribeParameters.Request(names=[each.name for each in table()]),
    )
    assert [each.description for each in described.descriptors] == [each.description for each in table()]
