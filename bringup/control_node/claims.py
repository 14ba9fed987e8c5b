"""Asks the fleet monitor for the place of a goal, so that no other robot is on its way there.

A monitor that is not there or says nothing stops nobody: the goal is driven to unclaimed, with a warning. It is asked
all the same until it answers, and what it then tells to be another robot's place is not driven to any more.
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
        self._driven_to: Message = None
        # Whether a question was dropped: the monitor may have granted a place that nobody drives to.
        self._dropped = False
        # Whether the goal that is driven to is still to be claimed.
        self._overdue = False

    def ask(self, goal: Message) -> None:
        """Ask for the place of a goal; a question before this one is dropped."""
        self._dropped |= self._answer is not None
        self._goal, self._since, self._answer = goal, monotonic(), None
        self._overdue = False

    def refusal(self) -> str | None:
        """Why the place is taken; '' if it may be driven to, None while that is not known yet."""
        answer = self._answered()
        if answer is not None:
            if answer.granted:
                return self._free()
            if self._dropped:
                self._restore()
            return _told(answer)
        if monotonic() - self._since < PATIENCE:
            return None
        self._node.get_logger().warning(f"{self.service} does not answer: the goal is not claimed")
        self._overdue = True
        return self._free()

    def late_refusal(self) -> str:
        """Why the place that is driven to unclaimed is taken; '' as long as nobody says so.

        The monitor is asked again and again: an answer that comes before both know each other is lost.
        """
        if self._overdue and monotonic() - self._since >= PATIENCE:
            if self._answer is not None:
                self._claim.remove_pending_request(self._answer)
            self._since, self._answer = monotonic(), None
        answer = self._answered() if self._overdue else None
        if answer is None:
            return ""
        self._overdue = False
        return "" if answer.granted else _told(answer)

    def withdraw(self) -> None:
        """The goal asked for is not driven to after all: its place is given back once it is known to be granted."""
        if self._answer is not None:
            self._dropped = True
            self._answer.add_done_callback(
                lambda answer: self._restore() if answer.result().granted else None
            )
            self._answer = None

    def release(self) -> None:
        """Give the place back; nobody waits for the answer."""
        self._driven_to = None
        if self._overdue:
            self._overdue = False
            self.withdraw()
        if self._release.service_is_ready():
            self._release.call_async(ReleaseGoal.Request(robot=self._robot))

    def _answered(self) -> Message | None:
        """What the monitor says, which is asked as soon as it is there; None as long as it says nothing."""
        if self._answer is None and self._claim.service_is_ready():
            self._answer = self._claim.call_async(ClaimGoal.Request(robot=self._robot, goal=self._goal))
        if self._answer is None or not self._answer.done():
            return None
        answer, self._answer = self._answer.result(), None
        return answer

    def _free(self) -> str:
        self._driven_to, self._dropped = self._goal, False
        return ""

    def _restore(self) -> None:
        """Have the monitor hold the place that is driven to, or none. Its answer would change nothing."""
        self._dropped = False
        if self._driven_to is None:
            self.release()
        else:
            self._claim.call_async(ClaimGoal.Request(robot=self._robot, goal=self._driven_to))

    def close(self) -> None:
        """Leave the graph."""
        self._node.destroy_client(self._claim)
        self._node.destroy_client(self._release)


def _told(answer: Message) -> str:
    return answer.message or f"{answer.holder} has claimed the place"
