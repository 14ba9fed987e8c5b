"""Ticks in a row are published as if each had been by itself: the same messages, to the last bit."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import pytest
import rclpy
from nav_msgs.msg import Odometry
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import HistoryPolicy, QoSProfile, qos_profile_sensor_data
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, JointState, LaserScan
from std_msgs.msg import UInt32

from bringup.world.course import Course
from bringup.world.inbox import Inbox
from bringup.world.messages import ticks_of
from bringup.world.settings import TABLE, settings

if TYPE_CHECKING:
    from pathlib import Path

DOMAIN = 51
TICKS = 200
# Robot1 drives into a wall and back.
DRIVEN = "time,robot,linear,angular\n0,robot1,0.8,0.0\n1.5,robot1,-0.8,0.4\n0,robot2,0.3,-0.5\n"
ALL = QoSProfile(history=HistoryPolicy.KEEP_ALL)
TOPICS = {
    "/clock": Clock,
    "/robot1/imu/data": Imu,
    "/robot1/wheel/odometry": Odometry,
    "/robot1/ground_truth": Odometry,
    "/robot1/joint_states": JointState,
    "/robot1/contacts": UInt32,
    "/robot1/scan": LaserScan,
    "/robot2/imu/data": Imu,
}


@pytest.fixture
def node(monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    context = Context()
    rclpy.init(context=context, domain_id=DOMAIN)
    node = Node("world", context=context)
    yield node
    node.destroy_node()
    context.shutdown()


def said(node: Node, script: Path, most: int, unheard: int = 0) -> tuple[dict[str, list[Any]], int]:
    """Every message of a world that works out so many ticks in a row, and in how many rows it has come to its end.

    Nobody listens to its first ticks.
    """
    values = {setting.name: setting.default for setting in TABLE} | {
        "script": str(script),
        "duration": TICKS / 100,
        "odometry_rate": 30.0,
        "start_poses": [4.2, 0.0, 0.0, -3.0, 1.0, 2.0],
    }
    course = Course(node, settings(values))
    for _ in range(unheard):
        assert course.tick()
    inboxes = {
        topic: Inbox(node, kind, topic, qos_profile_sensor_data if kind is LaserScan else ALL)
        for topic, kind in TOPICS.items()
    }
    deadline = time.monotonic() + 30.0
    publishers = [each for each in node.publishers if each.topic_name in TOPICS]
    while not all(each.get_subscription_count() for each in publishers):
        assert time.monotonic() < deadline
        time.sleep(0.01)
    heard: dict[str, list[Any]] = {topic: [] for topic in TOPICS}
    rows = 0
    while not course.finished:
        assert course.tick(most)
        rows += 1
        for topic, inbox in inboxes.items():
            while (message := inbox.oldest()) is not None:
                heard[topic].append(message)
    return heard, rows


def close(node: Node) -> None:
    """Take a world off the graph, so that there is room for another one."""
    for publisher in list(node.publishers):
        node.destroy_publisher(publisher)
    for subscription in list(node.subscriptions):
        node.destroy_subscription(subscription)


def test_ticks_in_a_row_say_what_they_say_one_by_one(node: Node, tmp_path: Path) -> None:
    script = tmp_path / "drive.csv"
    script.write_text(DRIVEN)
    single, rows = said(node, script, 1)
    assert rows == TICKS
    close(node)
    together, rows = said(node, script, 20)
    # A row ends where a scan is taken, each tenth tick, and where a touch begins or ends.
    assert TICKS / 10 < rows < TICKS / 5
    assert [ticks_of(each.clock) for each in single["/clock"]] == list(range(1, TICKS + 1))
    assert single["/robot1/contacts"][-1].data > 0
    for topic in TOPICS:
        assert together[topic] == single[topic], topic
    assert len(single["/robot1/wheel/odometry"]) == 30 * TICKS // 100
    assert len(single["/robot1/scan"]) == TICKS // 10


def test_whoever_listens_late_hears_what_all_have_heard_since(node: Node, tmp_path: Path) -> None:
    """What nobody hears is not said, and that changes nothing in what is said later."""
    script = tmp_path / "drive.csv"
    script.write_text(DRIVEN)
    whole, _ = said(node, script, 1)
    close(node)
    late, _ = said(node, script, 5, unheard=95)
    assert [ticks_of(each.clock) for each in late["/clock"]] == list(range(96, TICKS + 1))
    for topic in TOPICS.keys() - {"/robot1/contacts"}:
        assert late[topic] == whole[topic][-len(late[topic]) :], topic
    assert len(late["/robot1/scan"]) == 11
