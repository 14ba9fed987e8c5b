"""Takes the messages of one topic, as bytes, when somebody looks: no message wakes anybody.

What comes at 1 kHz costs 4 % of a core so, and 39 % by the executor (measured for `orchestra.ros.observer.rate`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.callback_groups import CallbackGroup
from rclpy.event_handler import SubscriptionEventCallbacks, UnsupportedEventTypeError
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy, qos_profile_sensor_data

from orchestra.ros.tools.graph.qos import matched
from orchestra.ros.tools.losses import Losses

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rclpy.node import Node
    from rclpy.qos import QoSProfile

    from orchestra.ros.tools.bag.storing import Message

_NUMBERS = 0xFFFFFFFF  # what an MCAP has for the number of a message


class _Outside(CallbackGroup):
    """Keeps the executor from ever waiting for what belongs to it."""

    def can_execute(self, _entity: object) -> bool:
        """Nothing here is for the executor."""
        return False


class Tap:
    """A subscription with the QoS that all publishers of its topic offer, or with a profile that is given.

    `notes` are what is to be said about that, `lost` hears how many messages are missing: by their numbers, or because
    the middleware could not deliver them. Those that somebody who has just begun to publish sent before we had met are
    among the latter, and not here.
    """

    def __init__(
        self,
        node: Node,
        topic: str,
        kind: Any,  # noqa: ANN401 - a class of an untyped package
        publishers: Sequence[Any],
        lost: Callable[[int], None],
        profile: QoSProfile | None = None,
    ) -> None:
        self._node = node
        self._topic = topic
        self._kind = kind
        self._lost = lost
        self._losses = self._counted()
        # Who was there at the latest look, and at the one before.
        self._there, self._before = _identities(publishers), frozenset[bytes]()
        self._meeting = True
        self._fixed = profile is not None
        self._profile, self.notes = matched(publishers, qos_profile_sensor_data)
        if profile is not None:
            self._profile, self.notes = profile, []
        self._subscribe()

    def take(self) -> list[Message]:
        """Return what has come: topic, times of receipt and of publishing in nanoseconds, number, bytes."""
        found: list[Message] = []
        handle = self._subscription.handle
        with handle:
            while taken := handle.take_message(self._kind, True):
                data, about = taken
                number = about["publication_sequence_number"]
                self._losses.number(number)
                times = (about["received_timestamp"], about["source_timestamp"])
                found.append((self._topic, *times, (number or 0) & _NUMBERS, data))
        return found

    def meet(self, publishers: Sequence[Any]) -> None:
        """See whether somebody has begun to publish at this look or the last one: what is lost is told late."""
        there = _identities(publishers)
        self._meeting = not there <= self._before
        self._there, self._before = there, self._there

    def follow(self, publishers: Sequence[Any]) -> list[Message]:
        """Hear those too who have come and offer less; return what had come for the subscription until then."""
        wanted, notes = matched(publishers, qos_profile_sensor_data)
        if self._fixed or not publishers or not _less(wanted, self._profile):
            return []
        self._profile, self.notes = wanted, notes
        rest = self.take()
        self.close()
        self._losses = self._counted()  # what comes between both is heard by neither
        self._subscribe()
        return rest

    def close(self) -> None:
        """Take nothing more."""
        for waitable in self._waitables:
            self._node.remove_waitable(waitable)
            waitable.destroy()
        self._node.destroy_subscription(self._subscription)

    def _subscribe(self) -> None:
        node = self._node
        self._subscription = node.create_subscription(
            self._kind,
            self._topic,
            _ignore,
            self._profile,
            callback_group=_Outside(),
            event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
            raw=True,
        )
        # What is lost is for the executor to hear, unlike the messages.
        events = SubscriptionEventCallbacks(
            message_lost=lambda event: self._lose(event.total_count_change), use_default_callbacks=False
        )
        handle = self._subscription.handle
        try:
            made = events.create_event_handlers(node.default_callback_group, handle, self._topic)
        except UnsupportedEventTypeError:
            made = []
        self._waitables = made
        for waitable in made:
            node.add_waitable(waitable)

    def _lose(self, count: int) -> None:
        if not self._meeting:
            self._losses.unheard(count)

    def _counted(self) -> Losses:
        look = self._node.get_publishers_info_by_topic
        return Losses(lambda: _identities(look(self._topic)), lambda more, _: self._lost(more))


def _identities(publishers: Sequence[Any]) -> frozenset[bytes]:
    return frozenset(bytes(one.endpoint_gid) for one in publishers)


def _less(wanted: QoSProfile, had: QoSProfile) -> bool:
    """Tell whether a profile asks for less than another."""
    return bool(
        (wanted.reliability == ReliabilityPolicy.BEST_EFFORT != had.reliability)
        or (wanted.durability == DurabilityPolicy.VOLATILE != had.durability)
    )


def _ignore(_data: bytes) -> None:
    """Nobody calls this: the messages are taken."""
