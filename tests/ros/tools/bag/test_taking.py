"""What is recorded of one topic, and what is missing of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

pytest.importorskip("rclpy", reason="needs ROS")
pytest.importorskip("mcap", reason="needs the extra `ros`")

import rclpy
from rclpy.duration import Duration
from rclpy.qos import HistoryPolicy, QoSProfile
from std_msgs.msg import Int32

from orchestra.ros.tools.bag.taking import Tap
from orchestra.testing.domain import free_domain
from tests.supervise.plans import wait_for

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rclpy.node import Node

    from orchestra.ros.tools.bag.storing import Message


@pytest.fixture
def node(monkeypatch: pytest.MonkeyPatch) -> Iterator[Node]:
    """A node in a domain of its own."""
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    with free_domain({}) as domain:
        context = rclpy.Context()
        rclpy.init(context=context, domain_id=domain)
        made = rclpy.create_node("both", context=context, enable_rosout=False, start_parameter_services=False)
        try:
            yield made
        finally:
            made.destroy_node()
            rclpy.shutdown(context=context)


def test_what_had_to_make_room_is_missed_also_of_who_has_just_begun(node: Node) -> None:
    missed: list[int] = []
    publisher = node.create_publisher(Int32, "/quick", QoSProfile(history=HistoryPolicy.KEEP_ALL, depth=1))
    tap = Tap(node, "/quick", Int32, node.get_publishers_info_by_topic("/quick"), missed.append)
    taken: list[Message] = []

    def some() -> bool:
        publisher.publish(Int32())
        taken.extend(tap.take())
        return bool(taken)

    wait_for(some, "a message")
    for _ in range(1500):
        publisher.publish(Int32())
    assert publisher.wait_for_all_acked(Duration(seconds=30.0))
    publisher.publish(Int32())
    last = taken[-1][3]

    def all_of_them() -> bool:
        taken.extend(tap.take())
        return taken[-1][3] > last + 1500

    wait_for(all_of_them, "the last message")
    tap.close()
    numbers = [message[3] for message in taken]
    assert numbers[-1] - numbers[0] + 1 == len(numbers) + sum(missed)
    assert sum(missed) > 400
