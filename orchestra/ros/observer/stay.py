"""Keeps the observer here for a lifecycle node that will have to change its state at its end, and the clients for that.

Then it already knows the node, and the node knows the clients: an order takes some milliseconds instead of the start of
a process with rclpy and the time that discovery needs.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.ros.observer.peer import peers_of

if TYPE_CHECKING:
    from rclpy.node import Node

    from orchestra.ros.observer.order import Request, Say


class Stay:
    """Does nothing until it is forgotten. `node` is the full name of the node."""

    every = None

    def __init__(self, node: Node, request: Request, _say: Say) -> None:
        self._peers = peers_of(node)
        self._name = request["node"]
        self._peers.join(self._name).clients()

    def look(self) -> None:
        """Nothing has to be looked for."""

    def close(self) -> None:
        """Leave the node alone."""
        self._peers.leave(self._name)
