"""Listens to whatever publishers of a topic offer.

A subscription must ask for no more than a publisher offers to be matched (REP 2004's QoS compatibility rules), so there
is one for every combination of reliability and durability that some publisher offers: whichever publishes first is
heard.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from orchestra.ros.interfaces import UnknownMessageTypeError, message_type
from orchestra.ros.observer.order import ImpossibleError

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node
    from rclpy.subscription import Subscription


class Offer(NamedTuple):
    """What a publisher offers, by what decides who hears it."""

    type: str
    reliability: ReliabilityPolicy
    durability: DurabilityPolicy

    def profile(self, depth: int) -> QoSProfile:
        """Return what to ask for."""
        return QoSProfile(
            history=HistoryPolicy.KEEP_LAST,
            depth=depth,
            reliability=self.reliability,
            durability=self.durability,
        )


class Offered:
    """Subscriptions to one topic; `heard` gets each message, as bytes where it is of no one type that is asked for."""

    def __init__(
        self, node: Node, topic: str, heard: Callable[[Any], None], *, depth: int, only: str | None = None
    ) -> None:
        self._node = node
        self._topic = topic
        self._heard = heard
        self._depth = depth
        self._only = only
        self._subscriptions: dict[Offer, Subscription] = {}

    def look(self) -> None:
        """Subscribe to what publishers offer by now. Raises `ImpossibleError` where a type cannot be loaded."""
        for publisher in self._node.get_publishers_info_by_topic(self._topic):
            profile = publisher.qos_profile
            offer = Offer(publisher.topic_type, profile.reliability, profile.durability)
            if offer not in self._subscriptions and self._only in (None, offer.type):
                self._subscriptions[offer] = self._node.create_subscription(
                    message_class(offer.type, self._topic),
                    self._topic,
                    self._heard,
                    offer.profile(self._depth),
                    raw=self._only is None,
                )

    def close(self) -> None:
        """Give the subscriptions back."""
        for subscription in self._subscriptions.values():
            self._node.destroy_subscription(subscription)
        self._subscriptions.clear()


def message_class(name: str, topic: str) -> Any:  # noqa: ANN401 - a class of an untyped package
    """Return the class of a topic's messages. Raises `ImpossibleError`."""
    try:
        return message_type(name)
    except (UnknownMessageTypeError, ImportError) as error:
        raise ImpossibleError(f"{topic} carries {name}, which cannot be loaded: {error}") from error
