"""Waits for the first message on a topic.

A subscription must ask for no more than a publisher offers to be matched (REP 2004's QoS compatibility rules), so there
is one for every combination of reliability and durability that some publisher offers: whichever publishes first is
heard.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from orchestra.ros.interfaces import UnknownMessageTypeError, message_type

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.subscription import Subscription

    from orchestra.ros.observer.order import Request, Say


class FirstMessage:
    """`topic` is the name of the topic."""

    def __init__(self, node: Node, request: Request, say: Say) -> None:
        self._node = node
        self._topic: str = request["topic"]
        self._say = say
        self._subscriptions: dict[tuple[str, ReliabilityPolicy, DurabilityPolicy], Subscription] = {}
        self.looks = True

    def look(self) -> None:
        """Subscribe to what publishers offer by now."""
        for publisher in self._node.get_publishers_info_by_topic(self._topic):
            profile = publisher.qos_profile
            key = (publisher.topic_type, profile.reliability, profile.durability)
            if key not in self._subscriptions and self.looks:
                self._subscribe(key)

    def close(self) -> None:
        """Give the subscriptions back."""
        for subscription in self._subscriptions.values():
            self._node.destroy_subscription(subscription)
        self._subscriptions.clear()

    def _subscribe(self, key: tuple[str, ReliabilityPolicy, DurabilityPolicy]) -> None:
        name, reliability, durability = key
        try:
            kind = message_type(name)
        except (UnknownMessageTypeError, ImportError) as error:
            self.looks = False
            self._say("impossible", reason=f"{self._topic} carries {name}, which cannot be loaded: {error}")
            return
        profile = QoSProfile(
            history=HistoryPolicy.KEEP_LAST, depth=1, reliability=reliability, durability=durability
        )
        self._subscriptions[key] = self._node.create_subscription(
            kind, self._topic, self._came, profile, raw=True
        )

    def _came(self, _data: bytes) -> None:
        if self.looks:
            self.looks = False
            self._say("done")
