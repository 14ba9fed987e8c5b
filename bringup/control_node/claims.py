"""Asks the fleet monitor for the place of a goal, so that no other robot is on its way there.

A monitor that is not there or says nothing stops nobody: the goal is driven to unclaimed, with a warning.
"""

from __future__ import annotations

from pathlib import PurePosixPath
from time import monotonic
from typing import TYPE_CHECKING, Any, TypeAlias

from bringup.control_node.interfaces import ClaimGoal, ReleaseGoal

if TYPE_CHECKING:
    from rclpy.node import Node

Future: TypeAlias = Any
Message: TypeAlias = Any

# Seconds of the machine's clock, by which the monitor works too; a robot that it has not seen yet waits one there.
PATIENCE = 3.0


class Claims:
    """The clients for one service of claims, and the answer to the last question."""

    def __init__(self, node: Node, service: str) -> None:
        self.service = service
        self._node = node
        self._robot = node.get_namespace().lstrip("/")
        self._claim = node.create_client(ClaimGoal, service)
        self._release = node.create_client(ReleaseGoal, str(PurePosixPath(service).with_name("release_goal")))
        self._goal: Message = None
        self._since = 0.0
        self._answer: Future | None = None

    def ask(self, goal: Message) -> None:
        """Ask for the place of a goal; a question before this one is forgotten."""
        self._goal, self._since, self._answer = goal, monotonic(), None

    def refusal(self) -> str | None:
        """Why the place is taken; '' if it may be driven to, None while that is not known yet."""
        if self._answer is None and self._claim.service_is_ready():
            self._answer = self._claim.call_async(ClaimGoal.Request(robot=self._robot, goal=self._goal))
        if self._answer is not None and self._answer.done():
            answer = self._answer.result()
            return "" if answer.granted else answer.message or f"{answer.holder} has claimed the place"
        if monotonic() - self._since < PATIENCE:
            return None
        self._node.get_logger().warning(f"{self.service} does not answer: the goal is not claimed")
        return ""

    def release(self) -> None:
        """Give the place back; nobody waits for the answer."""
        if self._release.service_is_ready():
            self._release.call_async(ReleaseGoal.Request(robot=self._robot))

    def close(self) -> None:
        """Leave the graph."""
        self._node.destroy_client(self._claim)
        self._node.destroy_client(self._release)
