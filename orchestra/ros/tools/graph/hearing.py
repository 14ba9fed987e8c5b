"""Subscribing: the type and the QoS as the publishers have them, and messages as quickly as they come."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.event_handler import SubscriptionEventCallbacks, UnsupportedEventTypeError

from orchestra.errors import RunError
from orchestra.ros.tools.graph.names import NO_TOPIC, topics, unknown

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node
    from rclpy.qos import QoSProfile

    from orchestra.ros.tools.graph.joining import Graph

    Heard = Callable[[Any, dict[str, Any]], None]

_AT_ONCE = 1000


def publishers(graph: Graph, topic: str) -> list[Any]:
    """Return the publishers of a topic, once all of them are known."""
    graph.whole(lambda: sorted(identities(graph, topic)))
    return list(graph.node.get_publishers_info_by_topic(topic))


def identities(graph: Graph, topic: str) -> list[bytes]:
    """Return what each of the known publishers of a topic is told from all others by."""
    return [bytes(endpoint.endpoint_gid) for endpoint in graph.node.get_publishers_info_by_topic(topic)]


def type_of(graph: Graph, topic: str) -> str:
    """Return the one type of a topic. Raises `RunError` where there is none, or more than one."""
    types = graph.found(lambda: dict(topics(graph)).get(topic))
    if not types:
        raise unknown(NO_TOPIC, topic, (name for name, _ in topics(graph, every=False)))
    if len(types) > 1:
        raise RunError(f"{topic} has more than one type: {', '.join(types)}; say which one is meant")
    return types[0]


def subscribe(
    node: Node,
    kind: Any,  # noqa: ANN401 - a class of an untyped package
    topic: str,
    profile: QoSProfile,
    heard: Heard,
    *,
    raw: bool = False,
    lost: Callable[[Any], None] | None = None,
) -> None:
    """Hear a topic: each message with what the middleware says about it.

    Much of what has come in is taken at once, since each wait for more takes longer than taking a message.
    """

    def hear(message: Any, about: dict[str, Any]) -> None:  # noqa: ANN401 - as above
        heard(message, about)
        for _ in range(_AT_ONCE):
            with subscription.handle:
                taken = subscription.handle.take_message(kind, raw)
            if taken is None:
                return
            heard(*taken)

    def make(events: SubscriptionEventCallbacks) -> Any:  # noqa: ANN401 - as above
        return node.create_subscription(kind, topic, hear, profile, raw=raw, event_callbacks=events)

    try:
        subscription = make(SubscriptionEventCallbacks(message_lost=lost))
    except UnsupportedEventTypeError:
        subscription = make(SubscriptionEventCallbacks())
