"""How often each robot has touched something other than the floor."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bringup.world.model import FLOOR

if TYPE_CHECKING:
    from numpy.typing import NDArray

# A touch that comes back within this time is still the same one: bodies chatter where they rub.
SAME_TOUCH = 0.2


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


def touching_robots(geoms: NDArray[np.int32], owners: NDArray[np.int64]) -> set[int]:
    """Numbers of the robots that touch something; `geoms` has a row with two geoms for each contact."""
    pairs = owners[geoms]
    firm = pairs[(pairs != FLOOR).all(axis=1)]
    return {int(owner) for owner in firm.ravel() if owner >= 0} if firm.size else set()
