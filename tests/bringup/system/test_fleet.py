"""A fleet for real: robots are seen by the monitor, drive to goals, and never two of them to one place."""

from __future__ import annotations

import math
import re
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

pytest.importorskip("rclpy", reason="needs ROS")
pytest.importorskip("mujoco", reason="needs the bringup")

import rclpy
from nav_msgs.msg import Odometry
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from rclpy.qos import DurabilityPolicy, QoSProfile

from bringup.control_node.interfaces import GoToGoal
from bringup.fleet_node.interfaces import FleetSummary
from tests.bringup.greeting import greeting

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from orchestra.testing.run import Run

# What rclpy imports to find its types still uses the old name of a standard module.
pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")

_BRINGUP = Path(__file__).parents[3] / "bringup"
_PATIENCE = 90.0


class _Operator:
    """Sees the fleet and sends robots to goals."""

    def __init__(self, run: Run) -> None:
        self.run = run
        self.context = rclpy.Context()
        rclpy.init(context=self.context, domain_id=run.domain)
        self.node = rclpy.create_node("operator", context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.robots: dict[str, Any] = {}
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.node.create_subscription(FleetSummary, "/fleet_monitor/summary", self._hear, latched)
        self.clients: list[Any] = []

    def _hear(self, message: Any) -> None:
        self.robots = {each.name: each for each in message.robots}

    def until(self, condition: Callable[[], bool], what: str) -> None:
        end = time.monotonic() + _PATIENCE
        while not condition():
            late = time.monotonic() >= end
            assert not late, f"not within {_PATIENCE} s: {what}; {self.robots}\n{self.run.output}"
            self.executor.spin_once(timeout_sec=0.1)

    def _greet(self, robot: str) -> None:
        with greeting(self.node, f"/{robot}/velocity_controller") as known:
            self.until(known, f"{robot} knows its client")

    def send(self, robot: str, x: float, y: float) -> Any:
        """Send a robot to a place in its own frame; return what gives the result."""
        client = ActionClient(self.node, GoToGoal, f"/{robot}/go_to_goal")
        self.clients.append(client)
        self.until(client.server_is_ready, f"{robot} takes goals")
        self._greet(robot)
        goal = GoToGoal.Goal()
        goal.pose.header.frame_id = f"{robot}/odom"
        goal.pose.pose.position.x, goal.pose.pose.position.y = x, y
        sent = client.send_goal_async(goal)
        self.until(sent.done, f"{robot} answers")
        assert sent.result().accepted
        return sent.result().get_result_async()

    def let_drive(self, robot: str) -> None:
        """Let a robot drive that was started with no speed at all."""
        client = AsyncParameterClient(self.node, f"/{robot}/velocity_controller")
        self.until(client.services_are_ready, f"{robot} has parameters")
        self._greet(robot)
        changed = client.set_parameters([Parameter("max_linear_vel", value=0.5)])
        self.until(changed.done, f"{robot} has taken its speed")
        assert changed.result().results[0].successful

    def close(self) -> None:
        for client in self.clients:
            client.destroy()
        self.executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self.context)


@pytest.fixture
def operator(launch: Callable[..., Run]) -> Iterator[_Operator]:
    """Two robots, of which the first cannot drive yet: it holds its claim until it is let."""
    run = launch(
        str(_BRINGUP / "fleet.yaml"),
        *("robots:=robot1,robot2", "mode:=go_to_goal", "settings:="),
        "/robot1/velocity_controller:max_linear_vel:=0.0",
        "/robot1/velocity_controller:progress_timeout:=600.0",
    )
    run.wait_ready(timeout=60)
    operator = _Operator(run)
    try:
        yield operator
    finally:
        operator.close()


def _seen_from(robot: Any, x: float, y: float) -> tuple[float, float]:
    """Return a place of the world as a robot has it that stands where it started."""
    pose = robot.pose.pose
    turn = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
    east, north = x - pose.position.x, y - pose.position.y
    return (
        math.cos(turn) * east + math.sin(turn) * north,
        math.cos(turn) * north - math.sin(turn) * east,
    )


@pytest.mark.timeout(300)
def test_two_robots_are_not_sent_to_one_place(operator: _Operator) -> None:
    """The second is told who has it; when the first is there, the place is free again."""
    operator.until(
        lambda: [each.pose.header.frame_id for each in operator.robots.values()] == ["world"] * 2,
        "both robots are seen in the world",
    )
    first, second = operator.robots["robot1"], operator.robots["robot2"]
    turn = 2 * math.atan2(first.pose.pose.orientation.z, first.pose.pose.orientation.w)
    place = (
        first.pose.pose.position.x + 0.7 * math.cos(turn),
        first.pose.pose.position.y + 0.7 * math.sin(turn),
    )
    reached = operator.send("robot1", *_seen_from(first, *place))
    operator.until(
        lambda: operator.robots["robot1"].has_goal or reached.done(), "the claim of robot1 is told"
    )
    assert not reached.done(), f"{reached.result()}\n{operator.run.output}"
    refused = operator.send("robot2", *_seen_from(second, *place))
    operator.until(refused.done, "robot2 tells why it does not go")
    result = refused.result().result
    assert result.outcome == GoToGoal.Result.OVERRULED
    assert "robot1" in result.text
    operator.let_drive("robot1")
    operator.until(reached.done, "robot1 is there")
    result = reached.result().result
    assert result.outcome == GoToGoal.Result.REACHED, result.text
    assert result.final_distance <= 0.1
    operator.until(lambda: not operator.robots["robot1"].has_goal, "the claim ends")
    goes = operator.send("robot2", *_seen_from(second, *place))
    operator.until(lambda: operator.robots["robot2"].has_goal or goes.done(), "the place is robot2's")
    assert operator.robots["robot2"].has_goal, goes.result()


def _drives(run: Run, robot: str) -> bool:
    """Tell whether a robot has been seen at two places, and its filter says where it is."""
    found = re.findall(rf"{robot}: pose (x \S+ m, y \S+ m).*filter error \d", run.output)
    return len(set(found)) > 1


def _wait_until_all_drive(run: Run) -> None:
    end = time.monotonic() + _PATIENCE
    while not all(_drives(run, robot) for robot in ("robot1", "robot2")):
        assert time.monotonic() < end, run.output
        time.sleep(0.1)


@pytest.mark.long
@pytest.mark.timeout(180)
def test_all_nodes_run_in_one_process(launch: Callable[..., Run]) -> None:
    """The end of the world, which is one of them, ends the run."""
    run = launch(str(_BRINGUP / "container.yaml"), "duration:=7")
    assert run.wait(timeout=100) == 0
    assert all(_drives(run, robot) for robot in ("robot1", "robot2")), run.output
    assert run.logs("everything").count("0 contacts") == 2


@pytest.mark.long
@pytest.mark.timeout(180)
def test_managed_controllers_are_brought_up_in_order(launch: Callable[..., Run]) -> None:
    run = launch(str(_BRINGUP / "lifecycle.yaml"))
    _wait_until_all_drive(run)
    assert run.stop() == 130
    assert run.logs("simulation").count("0 contacts") == 2


@pytest.mark.long
@pytest.mark.timeout(180)
def test_a_real_robot_drives_with_its_own_drivers(launch: Callable[..., Run], tmp_path: Path) -> None:
    """Drivers that name everything otherwise, and the machine's time."""
    drivers = tmp_path / "drivers.yaml"
    base = Path(__file__).with_name("base.py")
    drivers.write_text(
        "launch:\n  - arg: {name: namespace}\n"
        f"  - node: {{script: {base}, name: base, namespace: $(var namespace)}}\n",
        "utf-8",
    )
    names = ("scan:=lidar/scan", "imu:=base/imu", "odometry:=base/odom", "cmd_vel:=base/cmd_vel")
    run = launch(
        str(_BRINGUP / "real_robot.yaml"), f"drivers:={drivers}", "namespace:=r", "mode:=linear", *names
    )
    run.wait_ready(timeout=60)
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=run.domain)
    node = rclpy.create_node("passer_by", context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    far: list[float] = []
    node.create_subscription(
        Odometry, "/r/odometry/filtered", lambda message: far.append(message.pose.pose.position.x), 10
    )
    end = time.monotonic() + _PATIENCE
    while not far or far[-1] < 1.0:
        assert time.monotonic() < end, run.output
        executor.spin_once(timeout_sec=0.1)
    executor.shutdown()
    node.destroy_node()
    rclpy.shutdown(context=context)
    assert run.stop() == 130
