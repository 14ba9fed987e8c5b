"""What `topic echo` tells of messages that it could not show."""

from __future__ import annotations

import itertools
import re
from typing import TYPE_CHECKING

import pytest

pytest.importorskip("rclpy", reason="needs ROS")


import rclpy
from rclpy.qos import HistoryPolicy, QoSProfile
from std_msgs.msg import Int32MultiArray

from orchestra.ros.tools.losses import Losses
from tests.supervise.plans import wait_for

if TYPE_CHECKING:
    from tests.ros.tools.conftest import Graph


def _told(numbers: list[int | None], publishers: list[bytes], unheard: int = 0) -> list[tuple[int, int]]:
    """Return what is told of such numbers, one of them more each time, after the middleware has told of some."""
    told: list[tuple[int, int]] = []
    losses = Losses(lambda: publishers, lambda more, total: told.append((more, total)))
    if unheard:
        losses.unheard(unheard)
    for number in numbers:
        losses.number(number)
    return told


@pytest.mark.parametrize(
    ("numbers", "publishers", "told"),
    [
        ([1, 2, 3], [b"a"], []),
        ([7, 8, 9], [b"a"], []),  # began before we came
        ([7, 10, 11, 13], [b"a"], [(2, 2), (1, 3)]),
        ([7, 8, 1, 2], [b"a"], []),  # began again
        ([1, 7, 2, 8], [b"a", b"b"], []),  # two of them
        ([1, 1, 2, 2, 3, 3], [b"a", b"b"], []),
        ([1, 70, 2, 73], [b"a", b"b"], [(2, 2)]),
        ([None, None], [b"a"], []),
    ],
)
def test_numbers_say_what_has_not_come(
    numbers: list[int | None], publishers: list[bytes], told: list[tuple[int, int]]
) -> None:
    assert _told(numbers, publishers) == told


def test_one_who_comes_in_place_of_another_may_begin_anywhere() -> None:
    told: list[tuple[int, int]] = []
    there = [b"a"]
    losses = Losses(lambda: there, lambda more, total: told.append((more, total)))
    losses.number(1)
    there[:] = [b"b"]
    for number in (4, 5):
        losses.number(number)
    assert told == []  # it is another's 4
    losses.number(7)
    assert told == [(1, 1)]


def test_what_the_middleware_tells_of_is_told_once() -> None:
    assert _told([7, 10, 11], [b"a"], unheard=2) == [(2, 2)]
    assert _told([7, 11, 12], [b"a"], unheard=2) == [(2, 2), (1, 3)]


def test_what_a_slow_reader_makes_echo_lose_is_told(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody reads what it writes while more comes than it keeps."""
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=int(graph.environment["ROS_DOMAIN_ID"]))
    node = rclpy.create_node("much", context=context, enable_rosout=False, start_parameter_services=False)
    try:
        profile = QoSProfile(history=HistoryPolicy.KEEP_ALL, depth=1)
        publisher = node.create_publisher(Int32MultiArray, "/much", profile)
        with graph.asking("topic", "echo", "/much", "--csv", "--field", "data", "-f") as process:
            wait_for(lambda: publisher.get_subscription_count() == 1, "a subscription")
            for number in range(2000):
                publisher.publish(Int32MultiArray(data=[number] * 100))
            publisher.wait_for_all_acked()
            assert process.stdout is not None
            shown: list[int] = []
            while not shown or shown[-1] < 1999:
                shown += map(int, re.findall(r"\[(\d+),", process.stdout.readline()))
            process.terminate()
            told = process.communicate()[1]
    finally:
        node.destroy_node()
        rclpy.shutdown(context=context)
    missing = sum(two - one - 1 for one, two in itertools.pairwise(shown))
    assert missing
    assert int(re.findall(r"total count: (\d+)", told)[-1]) == missing
