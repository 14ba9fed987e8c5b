"""Who may drive where: no two robots hold goals nearer to each other than a distance.

Claims that come together are decided together, in an order that does not depend on which came first over the
network: by the stamps of their goals, then by the robots' names. What has been granted stays granted: an earlier stamp
that comes later takes nothing away, because the other robot is on its way.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from bringup.fleet.frames import Place

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from bringup.fleet.discovery import Presence


@dataclass(frozen=True, slots=True)
class Claim:
    """A goal that a robot asks for or holds.

    `place` is where it is in the outermost frame that is known, `stamp` its time in ns. `controllers` are those who
    drove the robot when it was granted: it ends where another one takes over, which knows nothing of it.
    """

    robot: str
    place: Place
    stamp: int
    controllers: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class Answer:
    """What a robot is told: granted where nobody is named."""

    holder: str = ""
    distance: float = 0.0
    incomparable: tuple[str, ...] = ()

    @property
    def granted(self) -> bool:
        """Whether the robot may drive there."""
        return not self.holder


# What each robot holds.
Held: TypeAlias = "Mapping[str, Claim]"


def decided(held: Held, asked: Sequence[Claim], apart: float) -> tuple[dict[str, Claim], list[Answer]]:
    """Return what is held after claims that came together, and an answer to each, in the order given.

    Goals must be `apart` metres from each other. A robot that is refused keeps what it held.
    """
    after, answers = dict(held), [Answer()] * len(asked)
    for index in sorted(range(len(asked)), key=lambda index: _order(asked[index])):
        claim = asked[index]
        answers[index] = _answer(claim, after, apart)
        if answers[index].granted:
            after[claim.robot] = claim
    return after, answers


def lasting(held: Held, present: Mapping[str, Presence]) -> dict[str, Claim]:
    """Return the claims that have not ended: the robot is there, and driven by nobody who has come since."""
    return {
        robot: claim
        for robot, claim in held.items()
        if robot in present and not _taken_over(claim, present[robot])
    }


def _taken_over(claim: Claim, presence: Presence) -> bool:
    return bool(claim.controllers) and not presence.controllers <= claim.controllers


def _order(claim: Claim) -> tuple[int, str, float, float, str]:
    return claim.stamp, claim.robot, claim.place.x, claim.place.y, claim.place.frame


def _answer(claim: Claim, held: Held, apart: float) -> Answer:
    others = [other for robot, other in sorted(held.items()) if robot != claim.robot]
    distances = [(claim.place.distance(other.place), other.robot) for other in others]
    near = min(((far, robot) for far, robot in distances if far is not None and far < apart), default=None)
    if near is not None:
        return Answer(near[1], near[0])
    return Answer(incomparable=_names(robot for far, robot in distances if far is None))


def _names(names: Iterable[str]) -> tuple[str, ...]:
    return tuple(sorted(names))
