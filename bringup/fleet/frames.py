"""Where frames stand in each other, in the plane, so that the goals of two robots can be compared."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Place:
    """A pose in the plane: metres and radians, in the frame that is named."""

    frame: str
    x: float
    y: float
    yaw: float = 0.0

    def distance(self, other: Place) -> float | None:
        """Return how far away another place is in metres; None where the frames are different."""
        return math.hypot(self.x - other.x, self.y - other.y) if self.frame == other.frame else None


class Frames:
    """A forest of frames, each with its pose in its parent."""

    def __init__(self) -> None:
        self._parents: dict[str, Place] = {}

    def put(self, child: str, pose: Place) -> None:
        """Set where a frame stands in its parent, the frame of `pose`."""
        self._parents[child] = pose

    def rooted(self, place: Place) -> Place:
        """Return the same place in the outermost frame that is known around its own.

        Frames that stand in themselves have no outermost one: then the place stays in its own.
        """
        found, passed = place, {place.frame}
        while (outer := self._parents.get(found.frame)) is not None:
            if outer.frame in passed:
                return place
            passed.add(outer.frame)
            found = _seen_from_outside(found, outer)
        return found


def _seen_from_outside(place: Place, frame: Place) -> Place:
    cosine, sine = math.cos(frame.yaw), math.sin(frame.yaw)
    return Place(
        frame.frame,
        frame.x + cosine * place.x - sine * place.y,
        frame.y + sine * place.x + cosine * place.y,
        math.remainder(frame.yaw + place.yaw, math.tau),
    )
