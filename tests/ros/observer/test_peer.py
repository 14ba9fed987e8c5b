"""What the observer keeps of a lifecycle node, with a real node of ours."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
import rclpy
from rclpy.context import Context

from orchestra.ros.observer.peer import Peers, peers_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rclpy.node import Node


@pytest.fixture
def node(monkeypatch: pytest.MonkeyPatch) -> Iterator[Node]:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF")
    context = Context()
    rclpy.init(args=[], context=context, domain_id=54)
    made = rclpy.create_node("ours", context=context, start_parameter_services=False, enable_rosout=False)
    yield made
    made.destroy_node()
    rclpy.shutdown(context=context)


def test_it_is_made_once_and_kept_for_a_while_after_its_last_user(node: Node) -> None:
    now = 0.0
    peers = Peers(node, lambda: now)
    first = peers.join("/managed")
    assert peers.join("/managed") is first
    peers.leave("/managed")
    now = 100.0
    assert peers.join("/managed") is first  # there was a user all the time
    peers.leave("/managed")
    peers.leave("/managed")
    now = 109.9
    assert peers.join("/managed") is first
    peers.leave("/managed")
    now = 119.9
    assert peers.join("/managed") is not first
    assert len([*node.subscriptions]) == 1


def test_those_who_only_listen_have_no_clients(node: Node) -> None:
    now = 0.0
    peers = Peers(node, lambda: now)
    peer = peers.join("/managed")
    assert [one.topic_name for one in node.subscriptions] == ["/managed/transition_event"]
    assert not [*node.clients]
    assert peer.clients() is peer.clients()
    assert [one.service_name for one in node.clients] == ["/managed/change_state", "/managed/get_state"]
    peers.leave("/managed")
    now = 10.0
    peers.join("/other")
    assert [one.topic_name for one in node.subscriptions] == ["/other/transition_event"]
    assert not [*node.clients]


def test_a_node_has_the_same_peers_each_time(node: Node) -> None:
    assert peers_of(node) is peers_of(node)
