"""Awaits what a look at the graph shows."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.ros.observer.order import OFTEN
from orchestra.ros.observer.participant import FreshEyes

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node

    from orchestra.ros.observer.order import Say


class Seen:
    """`there` tells whether the fact holds in the graph that a node sees.

    Where it holds from the beginning, it may be shown by what has been killed: then it has to hold for fresh eyes too.
    """

    def __init__(self, node: Node, say: Say, there: Callable[[Node], bool]) -> None:
        self._say = say
        self._there = there
        self._eyes = FreshEyes() if there(node) else None
        self._node = self._eyes.node if self._eyes else node
        self.every: float | None = OFTEN

    def look(self) -> None:
        """Look whether it holds."""
        if self._there(self._node):
            self.every = None
            self._say("done")

    def close(self) -> None:
        """Give the participant back where it needed one."""
        if self._eyes:
            self._eyes.close()
