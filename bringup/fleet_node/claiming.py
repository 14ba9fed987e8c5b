"""The services `~/claim_goal` and `~/release_goal`: requests are taken together, and decided together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

from bringup.fleet.claims import Claim, decided, lasting
from bringup.fleet_node import visited
from bringup.fleet_node.ears import place_of, stamp_of
from bringup.fleet_node.interfaces import ClaimGoal, ReleaseGoal

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rclpy.node import Node

    from bringup.fleet.claims import Answer
    from bringup.fleet.discovery import Presence
    from bringup.fleet.frames import Frames

Message: TypeAlias = Any

# How long (ns) a robot may claim before it is seen: its request and its name come over the network in any order.
_UNSEEN = 1_000_000_000


@dataclass(frozen=True, slots=True)
class _Asked:
    request: Message
    header: Any
    at: int


class Claiming:
    """The claims that robots hold, and who is waiting for an answer."""

    def __init__(self, node: Node, frames: Frames) -> None:
        self._node = node
        self._frames = frames
        self._claim = visited.serve(node, ClaimGoal, "~/claim_goal")
        self._release = visited.serve(node, ReleaseGoal, "~/release_goal")
        self._asked: list[_Asked] = []
        self.held: dict[str, Claim] = {}
        self._goals: dict[str, Message] = {}

    @property
    def asking(self) -> set[str]:
        """The robots that wait for an answer."""
        return {each.request.robot for each in self._asked}

    def goal(self, robot: str) -> Message | None:
        """Return the goal that a robot holds, if any, as it was asked for."""
        return self._goals[robot] if robot in self.held else None

    def listen(self, steady: int) -> None:
        """Take the requests that have come; a release is answered at once. `steady` never stands, in ns."""
        for request, header in visited.requests(self._release):
            released = self.held.pop(request.robot, None) is not None
            self._release.send_response(ReleaseGoal.Response(released=released), header)
        self._asked += [_Asked(*each, steady) for each in visited.requests(self._claim)]

    def end(self, present: Mapping[str, Presence]) -> None:
        """Drop the claims of robots that are gone or driven by another controller."""
        lasted = lasting(self.held, present)
        for robot in self.held.keys() - lasted.keys():
            self._node.get_logger().info(f"{robot}: its claim has ended with its controller")
        self.held = lasted

    def answer(self, present: Mapping[str, Presence], apart: float, steady: int) -> None:
        """Decide what robots that are there have asked for; one that is not seen within a second is refused."""
        seen = [each for each in self._asked if each.request.robot in present]
        late = [each for each in self._asked if each not in seen and steady - each.at >= _UNSEEN]
        self._asked = [each for each in self._asked if each not in seen and each not in late]
        for each in late:
            known = ", ".join(present) or "none"
            told = f"there is no robot '{each.request.robot}' (there are: {known})"
            self._claim.send_response(ClaimGoal.Response(message=told), each.header)
        claims = [self._claimed(each.request, present) for each in seen]
        self.held, answers = decided(self.held, claims, apart)
        for each, answer in zip(seen, answers, strict=True):
            if answer.granted:
                self._goals[each.request.robot] = each.request.goal
            self._claim.send_response(_response(answer, apart), each.header)

    def _claimed(self, request: Message, present: Mapping[str, Presence]) -> Claim:
        goal = request.goal
        place = self._frames.rooted(place_of(goal.header.frame_id, goal.pose))
        return Claim(request.robot, place, stamp_of(goal.header), present[request.robot].controllers)


def _response(answer: Answer, apart: float) -> Message:
    told = f"{answer.holder} has a goal {answer.distance:.2f} m from there, less than {apart:g} m"
    if answer.granted:
        others = ", ".join(answer.incomparable)
        told = f"no transform tells how far the goals of {others} are from there" if others else ""
    return ClaimGoal.Response(
        granted=answer.granted, holder=answer.holder, distance=answer.distance, message=told
    )
