"""What is told on the wire of nodes and of the ends of topics is what rclpy tells of them."""

from __future__ import annotations

from argparse import Namespace
from typing import TYPE_CHECKING, Any

import pytest

pytest.importorskip("rclpy", reason="needs ROS")

import rclpy
from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import Int32
from std_srvs.srv import Empty

from orchestra.ros.tools.graph.action_names import actions_of
from orchestra.ros.tools.graph.names import listed
from orchestra.ros.tools.graph.qos import data_of
from orchestra.ros.tools.graph.seeing import looking
from orchestra.ros.tools.graph.wire import parameters as known
from orchestra.ros.tools.graph.wire.endpoints import Described
from orchestra.ros.tools.graph.wire.ends import end_of
from orchestra.testing.domain import free_domain

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rclpy.node import Node

_PROFILES: tuple[dict[str, Any], ...] = (
    {},
    {"reliability": ReliabilityPolicy.BEST_EFFORT, "durability": DurabilityPolicy.TRANSIENT_LOCAL},
    {"deadline": Duration(nanoseconds=100_000_000), "lifespan": Duration(seconds=2, nanoseconds=999_999_999)},
    {
        "liveliness": LivelinessPolicy.MANUAL_BY_TOPIC,
        "liveliness_lease_duration": Duration(nanoseconds=1_234_567_891),
    },
)
_BY_NODE = (
    "get_publisher_names_and_types_by_node",
    "get_subscriber_names_and_types_by_node",
    "get_service_names_and_types_by_node",
    "get_client_names_and_types_by_node",
)


@pytest.fixture
def nodes(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[Node]]:
    """Two nodes in a domain of their own, in one process."""
    with free_domain({}) as domain:
        monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
        monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        context = rclpy.Context()
        rclpy.init(context=context, domain_id=domain)
        made = [rclpy.create_node("one", namespace="/a/b", context=context)]
        made.append(rclpy.create_node("other", context=context))
        try:
            yield made
        finally:
            for node in made:
                node.destroy_node()
            rclpy.shutdown(context=context)


def test_nodes_and_ends_are_told_as_rclpy_tells_of_them(nodes: list[Node]) -> None:
    one, other = nodes
    for profile in _PROFILES:
        one.create_publisher(Int32, "/odd", QoSProfile(depth=3, **profile))
        other.create_subscription(Int32, "/odd", lambda _: None, QoSProfile(depth=3, **profile))
    other.create_service(Empty, "_hidden", lambda _, response: response)
    one.create_client(Empty, "/_hidden")
    with looking(Namespace(spin_time=60.0)) as graph:
        told = graph.whole(
            lambda: [
                graph.node.get_publishers_info_by_topic("/odd"),
                graph.node.get_subscriptions_info_by_topic("/odd"),
                [
                    [listed(getattr(graph.node, by_node)(*who), every=True) for by_node in _BY_NODE]
                    for who in (("one", "/a/b"), ("other", "/"), ("another", "/"))
                ],
            ]
        )
    publishers, subscriptions = (
        one.get_publishers_info_by_topic("/odd"),
        one.get_subscriptions_info_by_topic("/odd"),
    )
    assert [str(end) for end in told[0]] == [str(end) for end in publishers]
    assert [str(end) for end in told[1]] == [str(end) for end in subscriptions]
    assert [end.qos for end in told[0]] == [data_of(end.qos_profile) for end in publishers]
    assert [bytes(end.endpoint_gid) for end in told[1]] == [bytes(end.endpoint_gid) for end in subscriptions]
    for who, seen in zip((("one", "/a/b"), ("other", "/")), told[2], strict=False):
        assert seen == [listed(getattr(one, by_node)(*who), every=True) for by_node in _BY_NODE]
    assert told[2][2] == [[], [], [], []]


def test_an_action_is_known_by_what_its_server_tells() -> None:
    topics = [
        ("/go/_action/feedback", ["a/action/Go_FeedbackMessage"]),
        ("/go/_action/status", ["action_msgs/msg/GoalStatusArray"]),
        ("/no/_action/feedback", ["std_msgs/msg/Int32"]),
        ("/feedback", ["a/action/Go_FeedbackMessage"]),
    ]
    assert actions_of(topics) == [("/go", ["a/action/Go"])]


@pytest.mark.parametrize(
    "content", [b"", b"\1\0", b"\1\0\0\0\2\0"], ids=["none", "half a word", "no duration"]
)
def test_what_an_end_says_too_briefly_counts_as_not_said(content: bytes) -> None:
    """Whoever sends on the network may send anything."""
    fields = dict.fromkeys((known.DURABILITY, known.LIVELINESS, known.LIFESPAN, known.DEADLINE), content)
    end = end_of(Described(bytes(16), "rt/odd", "std_msgs::msg::dds_::Int32_", True, fields, "<"), None)
    assert (end.qos["lifespan"], end.qos["deadline"], end.qos["liveliness_lease_duration"]) == (None,) * 3
    assert end.qos["durability"] == ("transient_local" if len(content) > 3 else "volatile")
