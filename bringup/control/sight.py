"""From the ranges of a scan to points about the robot.

REP-117 and LaserScan.msg give the meaning: +inf is nothing within reach, -inf something too near to
measure, NaN a faulty ray. A range below the minimum is taken as something at the minimum, which errs on the
side of stopping; one above the maximum is no hit.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bringup.control.command import Pose

if TYPE_CHECKING:
    from collections.abc import Sequence

# A scan with more faulty rays than this tells too little to drive by.
MOST_FAULTY = 0.25


@dataclass(frozen=True, slots=True)
class Sight:
    """A usable scan: when it came, its points in the robot's frame, and where the robot was, if known.

    `clear` are the ends of the beams that met nothing, by which a way to a goal is planned.
    """

    at: float
    points: NDArray[np.float64]
    pose: Pose | None
    clear: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 2)))


def obstacle_points(
    ranges: Sequence[float] | NDArray[np.floating],
    angles: tuple[float, float],
    limits: tuple[float, float],
    lidar_x: float,
) -> NDArray[np.float64] | None:
    """Hits of one scan in the robot's frame, shape (n, 2), or None if the scan cannot be trusted.

    `angles` are the first ray's direction and the step to the next, `limits` the least and greatest range.
    """
    measured = np.asarray(ranges, dtype=np.float64)
    if measured.size == 0 or np.count_nonzero(np.isnan(measured)) > MOST_FAULTY * measured.size:
        return None
    hit = measured <= limits[1]
    near = np.maximum(measured[hit], limits[0])
    directions = _directions(measured.size, *angles)[hit]
    points: NDArray[np.float64] = directions * near[:, np.newaxis]
    points[:, 0] += lidar_x
    return points


def clear_points(
    ranges: Sequence[float] | NDArray[np.floating],
    angles: tuple[float, float],
    limits: tuple[float, float],
    lidar_x: float,
) -> NDArray[np.float64]:
    """Ends of the rays that met nothing within the greatest range, shape (n, 2); arguments as above."""
    measured = np.asarray(ranges, dtype=np.float64)
    points: NDArray[np.float64] = _directions(measured.size, *angles)[measured > limits[1]] * limits[1]
    points[:, 0] += lidar_x
    return points


def moved(points: NDArray[np.float64], seen_from: Pose, now_at: Pose) -> NDArray[np.float64]:
    """The same points as seen after the robot has moved from one pose to another."""
    turn = seen_from.yaw - now_at.yaw
    x, y = seen_from.x - now_at.x, seen_from.y - now_at.y
    cos, sin = np.cos(now_at.yaw), np.sin(now_at.yaw)
    shift = np.array([cos * x + sin * y, cos * y - sin * x])
    rotation = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    result: NDArray[np.float64] = points @ rotation + shift
    return result


@lru_cache(maxsize=4)
def _directions(count: int, first: float, step: float) -> NDArray[np.float64]:
    angles = first + step * np.arange(count)
    return np.column_stack((np.cos(angles), np.sin(angles)))
