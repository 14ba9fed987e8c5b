"""A way that was planned, and what it means for a robot that follows it."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bringup.control.costs import CLOSED, Costs
from bringup.control.grid import Points

if TYPE_CHECKING:
    from bringup.control.command import Pose

# A corner is passed from this near (m), even where the next one is not in sight yet.
PASSED = 0.05


@dataclass(frozen=True, slots=True)
class Way:
    """The corners still ahead in m, shape (n, 2), the last one at the place, and the costs that they are judged by."""

    corners: Points
    costs: Costs


def remaining(way: Way, pose: Pose) -> float:
    """Length in m from the robot over all corners."""
    steps = np.diff(_points(way, pose), axis=0)
    return float(np.hypot(steps[:, 0], steps[:, 1]).sum())


def is_free(way: Way, pose: Pose) -> bool:
    """Whether nothing is in the way by its costs."""
    return dearest(way, pose) < CLOSED


def dearest(way: Way, pose: Pose) -> int:
    """What the dearest cell on the way costs."""
    points = _points(way, pose)
    return max(way.costs.between(start, end) for start, end in itertools.pairwise(points))


def advanced(way: Way, pose: Pose) -> Way:
    """The way without the corners that need not be driven to: passed, or cut off without coming nearer to anything."""
    here = np.array([pose.x, pose.y])
    corners = way.corners
    while len(corners) > 1:
        around = max(way.costs.between(here, corners[0]), way.costs.between(corners[0], corners[1]))
        # Where the robot stands too near to something, every way begins with a closed cell: it drives out first.
        cut = around < CLOSED and way.costs.between(here, corners[1]) <= around
        if not cut and pose.distance(*corners[0]) >= PASSED:
            break
        corners = corners[1:]
    return replace(way, corners=corners)


def _points(way: Way, pose: Pose) -> Points:
    points: Points = np.concatenate(([[pose.x, pose.y]], way.corners))
    return points
