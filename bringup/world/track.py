"""What is kept of a run: recent true poses to compare with, and whole paths to draw, both in bounded memory."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Generic, TypeVar

from bringup.world.geometry import between

if TYPE_CHECKING:
    from collections.abc import Callable

    from bringup.world.geometry import Pose

Kept = TypeVar("Kept")

MOST_POINTS = 20_000


class Recent(Generic[Kept]):
    """The poses of the last ticks, by tick, as what they are `read` from: far more are kept than asked for."""

    def __init__(self, ticks: int, read: Callable[[Kept], Pose]) -> None:
        self._kept: deque[Kept] = deque(maxlen=ticks)
        self._read = read
        self._next = 0

    def add(self, kept: Kept) -> None:
        """Keep what the pose of the next tick is read from; the first one is tick 0."""
        self._kept.append(kept)
        self._next += 1

    def at(self, tick: float) -> Pose | None:
        """The pose at a tick or between two; None if it is not kept any more or not reached yet."""
        place = tick - (self._next - len(self._kept))
        if not 0.0 <= place <= len(self._kept) - 1:
            return None
        before = int(place)
        after = min(before + 1, len(self._kept) - 1)
        return between(self._read(self._kept[before]), self._read(self._kept[after]), place - before)


@dataclass(slots=True)
class Trail:
    """A driven path. When it grows too long every second point goes, and from then on every second one comes."""

    points: list[tuple[float, float]] = field(default_factory=list)
    _stride: int = 1
    _seen: int = 0

    def add(self, x: float, y: float) -> None:
        """Add the next point of the path, unless it is none (a filter may diverge)."""
        if not (math.isfinite(x) and math.isfinite(y)):
            return
        if self._seen % self._stride == 0:
            self.points.append((x, y))
        self._seen += 1
        if len(self.points) >= MOST_POINTS:
            del self.points[1::2]
            self._stride *= 2
