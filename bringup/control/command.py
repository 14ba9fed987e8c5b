"""The two values the whole room passes around: a velocity and a pose."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Command:
    """A velocity of a differential-drive robot: m/s ahead and rad/s counter-clockwise."""

    linear: float = 0.0
    angular: float = 0.0


STANDSTILL = Command()


@dataclass(frozen=True, slots=True)
class Pose:
    """Position and heading of the robot in its odometry frame."""

    x: float
    y: float
    yaw: float

    def bearing(self, x: float, y: float) -> float:
        """Direction of a point as the robot sees it, in -π..π, 0 straight ahead."""
        return wrapped(math.atan2(y - self.y, x - self.x) - self.yaw)

    def distance(self, x: float, y: float) -> float:
        """Distance to a point of the odometry frame."""
        return math.hypot(x - self.x, y - self.y)

    def ahead(self, bearing: float, distance: float) -> tuple[float, float]:
        """The point of the odometry frame that lies in that direction, that far away."""
        angle = self.yaw + bearing
        return self.x + distance * math.cos(angle), self.y + distance * math.sin(angle)


def wrapped(angle: float) -> float:
    """The same direction in -π..π."""
    return math.remainder(angle, math.tau)
