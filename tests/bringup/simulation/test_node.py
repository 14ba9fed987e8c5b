"""The node for real: a child process on a graph of its own, heard by a real subscriber."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from PIL import Image
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, LaserScan
from std_msgs.msg import UInt32

import bringup
from bringup.world.messages import pose_of, ticks_of
from orchestra.ros.interfaces import tf_message_type

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextlib import AbstractContextManager

    Start = Callable[..., AbstractContextManager[Any]]
    Listen = Callable[[int], AbstractContextManager[Any]]

PARAMETERS = Path(bringup.__file__).parent / "params" / "simulation.yaml"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
DRIVEN_TICKS = 200
DURATION = 8
DOMAIN = 27


@dataclass(frozen=True)
class Outcome:
    """A whole run under the namespace /fleet, in which robot1 was driven and robot2 was left alone."""

    heard: dict[str, list[Any]]
    status: int
    said: str
    picture: Path
    driven: list[float]  # the ticks whose ground truth was answered with a command


@pytest.fixture(scope="module")
def outcome(start: Start, listen: Listen, tmp_path_factory: pytest.TempPathFactory) -> Outcome:
    picture = tmp_path_factory.mktemp("run") / "run.png"
    arguments = [
        *("-r", "__ns:=/fleet", "--params-file", str(PARAMETERS), "-p", f"duration:={DURATION}"),
        *("-p", "status_period:=0.5", "-p", f"picture:={picture}"),
        *("-p", "start_poses:=[-2, 1, 0, 2, -2, 1]"),
    ]
    with listen(DOMAIN) as ears:
        driven = hear(ears)
        with start(DOMAIN, *arguments) as run:
            status, said = run.end()
        return Outcome(dict(ears.heard), status, said, picture, driven)


def hear(listener: Any) -> list[float]:
    """Hear robot1, drive it for two seconds, and play a filter that knows the truth."""
    driven: list[float] = []
    listener.listen(Clock, "/clock")
    listener.listen(tf_message_type(), "/tf_static", LATCHED)
    listener.listen(LaserScan, "/fleet/robot1/scan", qos_profile_sensor_data)
    listener.listen(Imu, "/fleet/robot1/imu/data")
    listener.listen(Odometry, "/fleet/robot1/wheel/odometry")
    listener.listen(Odometry, "/fleet/robot1/ground_truth")
    listener.listen(UInt32, "/fleet/robot1/contacts", LATCHED)
    listener.listen(Odometry, "/fleet/robot2/ground_truth")
    commands = listener.node.create_publisher(Twist, "/fleet/robot1/cmd_vel", 1)
    filtered = listener.node.create_publisher(Odometry, "/fleet/robot1/odometry/filtered", 10)

    def answer(truth: Odometry) -> None:
        filtered.publish(truth)
        ticks = ticks_of(truth.header.stamp)
        if not driven or ticks < driven[0] + DRIVEN_TICKS:
            driven.append(ticks)
            command = Twist()
            command.linear.x, command.angular.z = 0.4, 0.2
            commands.publish(command)

    listener.node.create_subscription(Odometry, "/fleet/robot1/ground_truth", answer, 10)
    return driven


def test_a_run_of_a_given_duration_ends_by_itself(outcome: Outcome) -> None:
    assert outcome.status == 0
    assert "Traceback" not in outcome.said
    clock = [ticks_of(message.clock) for message in outcome.heard["/clock"]]
    # The last messages may be lost with the node that sent them: whoever hears them may be behind, where all is busy.
    assert DURATION * 100 - 100 <= clock[-1] <= DURATION * 100
    assert re.search(rf"simulated {DURATION}\.00 s in .* real-time factor \d\.\d+", outcome.said)


@pytest.mark.parametrize(
    ("topic", "ticks"),
    [
        ("/fleet/robot1/scan", 10),
        ("/fleet/robot1/imu/data", 1),
        ("/fleet/robot1/wheel/odometry", 2),
        ("/fleet/robot1/ground_truth", 2),
        ("/fleet/robot2/ground_truth", 2),
    ],
)
def test_rates_are_exact_in_simulated_time(outcome: Outcome, topic: str, ticks: int) -> None:
    stamps = [ticks_of(message.header.stamp) for message in outcome.heard[topic]]
    assert all((after - before) % ticks == 0 for before, after in pairwise(stamps))
    assert all(after > before for before, after in pairwise(stamps))
    # A loaded machine may lose a message of the best-effort scan.
    expected = (stamps[-1] - stamps[0]) / ticks + 1
    assert 0.8 * expected <= len(stamps) <= expected
    assert stamps[-1] - stamps[0] > 0.3 * DURATION * 100


def test_the_clock_ticks_a_hundred_times_a_second(outcome: Outcome) -> None:
    ticks = [ticks_of(message.clock) for message in outcome.heard["/clock"]]
    assert len(ticks) > 30 * DURATION
    assert all(after == before + 1 for before, after in pairwise(ticks))


@pytest.mark.parametrize(
    ("topic", "frame", "child"),
    [
        ("/fleet/robot1/scan", "robot1/laser", None),
        ("/fleet/robot1/imu/data", "robot1/imu_link", None),
        ("/fleet/robot1/wheel/odometry", "robot1/odom", "robot1/base_footprint"),
        ("/fleet/robot1/ground_truth", "robot1/odom", "robot1/base_footprint"),
        ("/fleet/robot2/ground_truth", "robot2/odom", "robot2/base_footprint"),
    ],
)
def test_frames_carry_the_robots_name(outcome: Outcome, topic: str, frame: str, child: str | None) -> None:
    assert outcome.heard[topic]
    for message in outcome.heard[topic]:
        assert message.header.frame_id == frame
        assert getattr(message, "child_frame_id", None) == child


def test_static_transforms_are_one_tree_per_robot(outcome: Outcome) -> None:
    parents = {
        transform.child_frame_id: transform.header.frame_id
        for message in outcome.heard["/tf_static"]
        for transform in message.transforms
    }
    for robot in ("robot1", "robot2"):
        assert parents[f"{robot}/base_link"] == f"{robot}/base_footprint"
        for sensor in ("imu_link", "laser", "left_wheel", "right_wheel", "caster"):
            assert parents[f"{robot}/{sensor}"] == f"{robot}/base_link"
        # The root of the tree is left to the filter, which tells where it is.
        assert f"{robot}/base_footprint" not in parents
    assert len(parents) == 12


def test_the_robot_obeys_its_commands_and_stops_without_them(outcome: Outcome) -> None:
    truth = {
        ticks_of(message.header.stamp): message for message in outcome.heard["/fleet/robot1/ground_truth"]
    }
    fastest = max(message.twist.twist.linear.x for message in truth.values())
    assert fastest == pytest.approx(0.4, abs=0.03)
    last = truth[max(truth)]
    assert math.hypot(last.pose.pose.position.x, last.pose.pose.position.y) > 0.5
    # 0.2 s of patience, then braking at 4 m/s^2; the rest is what a loaded machine takes to deliver.
    end = outcome.driven[-1]
    # Where the orders came with a gap, it has stood before them too.
    moves = [tick for tick in truth if abs(truth[tick].twist.twist.linear.x) > 0.01]
    assert end + 20 < max(moves) < end + 250
    assert last.twist.twist.linear.x == pytest.approx(0.0, abs=0.001)
    alone = outcome.heard["/fleet/robot2/ground_truth"][-1].pose.pose.position
    assert math.hypot(alone.x, alone.y) < 0.001


def test_wheel_odometry_is_off_by_about_what_it_says(outcome: Outcome) -> None:
    truth = {
        ticks_of(message.header.stamp): message for message in outcome.heard["/fleet/robot1/ground_truth"]
    }
    wheel = outcome.heard["/fleet/robot1/wheel/odometry"][-1]
    told, true = pose_of(wheel), pose_of(truth[max(truth)])
    covariance = np.array(wheel.pose.covariance).reshape(6, 6)
    assert np.allclose(covariance, covariance.T)
    assert (np.diag(covariance) > 0.0).all()
    assert math.hypot(told.x - true.x, told.y - true.y) > 0.001
    assert abs(told.yaw - true.yaw) < 5 * math.sqrt(covariance[5, 5])
    assert abs(told.x - true.x) < 5 * math.sqrt(covariance[0, 0]) + 0.02
    assert abs(told.y - true.y) < 5 * math.sqrt(covariance[1, 1]) + 0.02


def test_the_imu_tells_what_it_does_not_know(outcome: Outcome) -> None:
    messages = outcome.heard["/fleet/robot1/imu/data"]
    assert all(message.orientation_covariance[0] == -1.0 for message in messages)
    rates = np.array([message.angular_velocity.x for message in messages])
    assert rates.std() == pytest.approx(0.005, rel=0.3)
    assert messages[0].angular_velocity_covariance[0] == pytest.approx(0.005**2, rel=0.05)
    assert np.mean([message.linear_acceleration.z for message in messages]) == pytest.approx(9.83, abs=0.05)


def test_scans_say_how_they_were_taken(outcome: Outcome) -> None:
    assert outcome.heard["/fleet/robot1/scan"]
    for scan in outcome.heard["/fleet/robot1/scan"]:
        assert len(scan.ranges) == 360
        assert scan.angle_min + 359 * scan.angle_increment == pytest.approx(scan.angle_max, abs=1e-5)
        assert all(
            scan.range_min <= distance <= scan.range_max or math.isinf(distance) for distance in scan.ranges
        )
        assert min(scan.ranges) > 0.25


def test_contacts_are_told_though_there_are_none(outcome: Outcome) -> None:
    counts = [message.data for message in outcome.heard["/fleet/robot1/contacts"]]
    assert len(counts) >= 0.3 * DURATION
    assert set(counts) == {0}
    assert "robot1: 0 contacts" in outcome.said


def test_status_lines_tell_pose_filter_and_obstacle(outcome: Outcome) -> None:
    where, off_by = r"x (\S+) m, y (\S+) m, yaw (\S+) rad", r"(\S+) m, (\S+) rad.*"
    pattern = rf"robot1: pose {where}; filter error {off_by}; nearest obstacle (\S+) m"
    lines = re.findall(pattern, outcome.said)
    assert len(lines) >= 3
    for line in lines:
        x, y, _, off, turn, nearest = map(float, line)
        assert max(abs(x), abs(y)) < 5.0
        # This filter repeats the truth of a moment ago, and is compared with the truth of that moment.
        assert off < 0.001
        assert turn < 0.001
        assert 0.25 < nearest < 5.0
    assert outcome.said.count("robot2: pose x 2.00 m, y -2.00 m, yaw 1.00 rad; filter no estimate yet;") >= 3


def test_the_picture_is_written_and_named(outcome: Outcome) -> None:
    assert f"picture written to {outcome.picture}" in outcome.said
    with Image.open(outcome.picture) as image:
        assert min(image.size) > 500
