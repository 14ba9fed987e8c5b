"""The first message on a topic has come."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.ros.observer.offered import Offered
from orchestra.ros.observer.order import OFTEN

if TYPE_CHECKING:
    from rclpy.node import Node

    from orchestra.ros.observer.order import Request, Say


class FirstMessage:
    """`topic` is the full name of the topic."""

    def __init__(self, node: Node, request: Request, say: Say) -> None:
        self._say = say
        self._subscriptions = Offered(node, request["topic"], self._came, depth=1)
        self.every: float | None = OFTEN

    def look(self) -> None:
        """Listen to whoever publishes by now."""
        self._subscriptions.look()

    def close(self) -> None:
        """Listen no longer."""
        self._subscriptions.close()

    def _came(self, _data: bytes) -> None:
        if self.every:
            self.every = None
            self._say("done")
