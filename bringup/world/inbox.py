"""Subscriptions that are looked into when it suits the simulation, instead of waking it.

Every message that wakes an executor makes it rebuild its wait set, which costs more than a step of the physics. The
simulation acts on its own grid of ticks, so it takes what has come when a tick begins.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.callback_groups import MutuallyExclusiveCallbackGroup

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.qos import QoSProfile


class Inbox:
    """A topic whose messages can be taken when it suits."""

    def __init__(self, node: Node, message: type, topic: str, qos: QoSProfile) -> None:
        self._message = message
        group = MutuallyExclusiveCallbackGroup()
        self._subscription = node.create_subscription(message, topic, _ignore, qos, callback_group=group)
        # A group that is at work for ever keeps its subscription out of every executor's wait set.
        group.beginning_execution(self._subscription)

    def oldest(self) -> Any:  # noqa: ANN401 - message classes have no types
        """The first of the messages that have come and were not taken, or None."""
        handle = self._subscription.handle
        with handle:
            taken = handle.take_message(self._message, False)
        return None if taken is None else taken[0]

    def newest(self) -> Any:  # noqa: ANN401 - message classes have no types
        """The last message that has come since the last call, or None."""
        newest, handle = None, self._subscription.handle
        with handle:
            while (taken := handle.take_message(self._message, False)) is not None:
                newest = taken[0]
        return newest


def _ignore(_message: object) -> None:
    """Never called: the executor does not see the subscription."""
