"""Keeps the observer here for a node that will have to be asked something at its end.

Then it already knows the node: an order takes some milliseconds instead of the start of a process with rclpy and the
time that discovery needs.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.node import Node

    from orchestra.ros.observer.order import Request, Say


class Stay:
    """Does nothing until it is forgotten."""

    every = None

    def __init__(self, node: Node, request: Request, say: Say) -> None:
        """Nothing is needed of all this."""

    def look(self) -> None:
        """Nothing has to be looked for."""

    def close(self) -> None:
        """Nothing has to be given back."""
