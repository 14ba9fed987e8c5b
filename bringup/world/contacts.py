"""What each robot touches other than the floor, and how often it has touched something."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bringup.world.model import FLOOR

if TYPE_CHECKING:
    from numpy.typing import NDArray

# A touch that comes back within this time is still the same one: bodies chatter where they rub.
SAME_TOUCH = 0.2


@dataclass(frozen=True, slots=True)
class Touch:
    """Two geoms that touch, at least one of them of a robot, and the numbers of the robots they belong to."""

    geoms: tuple[int, int]
    robots: tuple[int, ...]


@dataclass(slots=True)
class ContactCount:
    """One robot's episodes of contact, however many points or things touch at a time."""

    episodes: int = 0
    last_touch: float = -np.inf

    def update(self, time: float, touching: bool) -> None:
        """Take in whether the robot touches anything at `time` (seconds, never less than before)."""
        if not touching:
            return
        if time - self.last_touch > SAME_TOUCH:
            self.episodes += 1
        self.last_touch = time

    def clear(self) -> None:
        """Forget all of it."""
        self.episodes, self.last_touch = 0, -np.inf


def touches(geoms: NDArray[np.int32], owners: NDArray[np.int64]) -> tuple[Touch, ...]:
    """The touches of robots; `geoms` has a row with two geoms for each contact, a pair may stand there repeatedly."""
    pairs = owners[geoms]
    firm = (pairs != FLOOR).all(axis=1)
    if not firm.any():
        return ()
    found = {}
    for (one, other), owned in zip(geoms[firm].tolist(), pairs[firm].tolist(), strict=True):
        robots = tuple(owner for owner in owned if owner >= 0)
        if robots:
            found[one, other] = Touch((one, other), robots)
    return tuple(found.values())
