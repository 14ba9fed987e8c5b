"""What `doctor` says of QoS, held to what the middleware itself says."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any

import pytest

pytest.importorskip("rclpy", reason="needs ROS")

import rclpy
from rclpy.duration import Duration
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSPolicyKind, QoSProfile, ReliabilityPolicy
from std_msgs.msg import Empty

from orchestra.ros.tools.graph.qos import data_of
from orchestra.ros.tools.graph.system import End, mismatch

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rclpy.node import Node

_ENDLESS = Duration(nanoseconds=2**63 - 1)
_POLICIES = {
    "reliability": (ReliabilityPolicy.BEST_EFFORT, ReliabilityPolicy.RELIABLE),
    "durability": (DurabilityPolicy.VOLATILE, DurabilityPolicy.TRANSIENT_LOCAL),
    "deadline": (_ENDLESS, Duration(seconds=60)),
    "liveliness": (LivelinessPolicy.AUTOMATIC, LivelinessPolicy.MANUAL_BY_TOPIC),
}
_PROFILES = [dict(zip(_POLICIES, values, strict=True)) for values in itertools.product(*_POLICIES.values())]
# How long the durations are that can be asked for and offered; they differ in their order alone.
_SPANS: tuple[tuple[dict[str, Any], dict[str, Any]], ...] = (
    ({"deadline": Duration(seconds=50)}, {"deadline": Duration(seconds=60)}),
    (
        {"liveliness_lease_duration": Duration(seconds=50)},
        {"liveliness_lease_duration": Duration(seconds=60)},
    ),
    ({"liveliness_lease_duration": Duration(seconds=50)}, {}),
)
_NAMED = {
    QoSPolicyKind.RELIABILITY: {"reliability"},
    QoSPolicyKind.DURABILITY: {"durability"},
    QoSPolicyKind.DEADLINE: {"deadline"},
    QoSPolicyKind.LIVELINESS: {"liveliness", "lease duration"},
    QoSPolicyKind.LIVELINESS_LEASE_DURATION: {"lease duration"},
}


@pytest.fixture
def node(free_domain_number: int, monkeypatch: pytest.MonkeyPatch) -> Iterator[Node]:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=free_domain_number)
    made = rclpy.create_node("judge", context=context, enable_rosout=False, start_parameter_services=False)
    try:
        yield made
    finally:
        made.destroy_node()
        rclpy.shutdown(context=context)


def test_all_pairs_are_judged_as_the_middleware_judges_them(node: Node) -> None:
    """Each policy with each, in all combinations: 256 pairs, of which 32 differ in one policy or none."""
    pairs = list(itertools.product(_PROFILES, _PROFILES))
    pairs += [pair for one, other in _SPANS for pair in itertools.product((one, other), (one, other))]
    verdicts = _verdicts(node, pairs)
    assert len(verdicts) == len(pairs)
    ours = _ours(node, len(pairs))
    for place, last in verdicts.items():
        assert bool(ours[place]) == (last is not None), pairs[place]
        if last is not None:
            assert ours[place] & _NAMED[last], pairs[place]
    assert sum(last is not None for last in verdicts.values()) > 100


def _verdicts(node: Node, pairs: list[tuple[Any, Any]]) -> dict[int, QoSPolicyKind | None]:
    """Return of each pair the last policy that the middleware found not to fit, None where it was connected."""
    found: dict[int, QoSPolicyKind | None] = {}
    for place, (offered, asked) in enumerate(pairs):

        def refused(event: Any, place: int = place) -> None:
            found[place] = QoSPolicyKind(event.last_policy_kind)

        def matched(_event: Any, place: int = place) -> None:
            found[place] = None

        events = SubscriptionEventCallbacks(incompatible_qos=refused, matched=matched)
        node.create_publisher(Empty, f"pair{place}", QoSProfile(depth=1, **offered))
        node.create_subscription(
            Empty, f"pair{place}", lambda _: None, QoSProfile(depth=1, **asked), event_callbacks=events
        )
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    while len(found) < len(pairs):  # the time limit of the test ends it
        executor.spin_once(timeout_sec=1.0)
    executor.shutdown()
    return found


def _ours(node: Node, count: int) -> list[set[str]]:
    """Return of each pair the policies that we find not to fit, in what the graph shows of it."""
    return [
        {
            one.policy
            for one in mismatch(
                _end(node.get_publishers_info_by_topic(f"/pair{place}")),
                _end(node.get_subscriptions_info_by_topic(f"/pair{place}")),
            )
        }
        for place in range(count)
    ]


def _end(endpoints: list[Any]) -> End:
    (one,) = endpoints
    return End("", "", "", "", "", data_of(one.qos_profile))
