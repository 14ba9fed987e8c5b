"""What has come to where nothing was a moment ago: other robots, and people.

A scan alone does not tell a robot from a post. The grid of a journey does: where a beam has passed and now something
stands, something has come there. It is followed from scan to scan, also while it stands.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bringup.control.costs import near
from bringup.control.grid import Grid, world

if TYPE_CHECKING:
    from bringup.control.command import Pose
    from bringup.control.grid import Points

# How far (m) things that move are looked for.
WATCHED = 4.0
# Evidence of cells that were seen free for sure, and how far (m) they are from all that was seen in them.
FREE, ALONE = -4, 0.2
# A thing has so many points at least, and this share of those of one that has come is where nothing was.
FEWEST, MOST = 2, 0.5
# Neighbours in a scan farther apart (m) belong to two things; a wider one (m) than this is a wall.
GAP, WIDEST = 0.2, 0.7
# The middle of something round lies so far (m) behind what is seen of it.
BEHIND = 0.15
# What has come no farther (m) than this has not moved.
STILL = 0.3
# How far (m) a thing comes from scan to scan at most.
STEP = 0.35
# Nothing else is so near (m) to the middle of what moves; where it began to move it has left a trace so far (m) away.
BODY, TRAIL = 0.22, 1.2
# What has not been seen for so many seconds is not followed any more.
LOST = 2.0
# The share of the newest scan in what is known about a velocity.
NEWEST = 0.3


@dataclass(frozen=True, slots=True)
class Mover:
    """Something that moves: its middle in m of the odometry frame, its velocity in m/s, when it was seen.

    `stands` is where it was when it last moved on, and when that was.
    """

    x: float
    y: float
    vx: float
    vy: float
    at: float
    number: int
    stands: tuple[float, float, float]


def followed(
    movers: tuple[Mover, ...], grid: Grid, eye: Pose, points: Points, now: float
) -> tuple[Mover, ...]:
    """The things that move after a scan, its points in the frame of the robot at `eye`; `grid` is without it."""
    close = points[np.einsum("ij,ij->i", points, points) < WATCHED * WATCHED]
    left = [each for each in movers if 0.0 <= now - each.at < LOST]
    result: list[Mover] = []
    number = 1 + max((each.number for each in movers), default=0)
    for thing in _things(world(eye, close)):
        middle = _middle(thing, eye)
        last = min(left, key=lambda each: math.hypot(each.x - middle[0], each.y - middle[1]), default=None)
        if last is not None and math.hypot(last.x - middle[0], last.y - middle[1]) < STEP:
            left.remove(last)
            result.append(_moved(last, middle, now))
        elif _has_come(grid, thing):
            result.append(Mover(*middle, 0.0, 0.0, now, number, (*middle, now)))
            number += 1
    return (*result, *left)


def without(grid: Grid, movers: tuple[Mover, ...], before: tuple[Mover, ...]) -> Grid:
    """The grid without what moves; of what did not `before` also without where it seems to have stood till then."""
    if not movers:
        return grid
    evidence = grid.evidence.copy()
    known = {each.number for each in before}
    for each in movers:
        here = near(grid, (each.x, each.y), BODY if each.number in known else TRAIL)
        evidence[here] = np.minimum(evidence[here], 0)
    return replace(grid, evidence=evidence)


def _about(grid: Grid, place: tuple[float, float], reach: float) -> tuple[slice, slice]:
    ((row, column),) = grid.cells(np.array([place])).tolist()
    wide = round(reach / grid.resolution)
    return slice(max(0, row - wide), row + wide + 1), slice(max(0, column - wide), column + wide + 1)


def _things(points: Points) -> list[Points]:
    """The points of a scan, in its order, as things that are no walls."""
    if len(points) < FEWEST:
        return []
    apart = np.hypot(*np.diff(points, axis=0).T)
    parts = np.split(points, np.flatnonzero(apart > GAP) + 1)
    if len(parts) > 1 and math.dist(points[0], points[-1]) <= GAP:
        parts = [np.concatenate((parts[-1], parts[0])), *parts[1:-1]]
    return [each for each in parts if len(each) >= FEWEST and math.dist(each[0], each[-1]) < WIDEST]


def _middle(thing: Points, eye: Pose) -> tuple[float, float]:
    x, y = thing.mean(axis=0).tolist()
    away = max(math.hypot(x - eye.x, y - eye.y), BEHIND)
    return x + BEHIND * (x - eye.x) / away, y + BEHIND * (y - eye.y) / away


def _moved(last: Mover, middle: tuple[float, float], now: float) -> Mover:
    elapsed = now - last.at
    if elapsed <= 0.0:
        return last
    vx, vy = ((new - old) / elapsed for new, old in zip(middle, (last.x, last.y), strict=True))
    vx, vy = last.vx + NEWEST * (vx - last.vx), last.vy + NEWEST * (vy - last.vy)
    x, y, _ = last.stands
    stands = last.stands if math.dist(middle, (x, y)) < STILL else (*middle, now)
    return Mover(*middle, vx, vy, now, last.number, stands)


def _has_come(grid: Grid, thing: Points) -> bool:
    """Whether most of a thing stands where nothing was, away from all that was there."""
    cells = grid.cells(thing)
    cells = cells[grid.inside(cells)]
    if not len(cells):
        return False
    new = grid.evidence[cells[:, 0], cells[:, 1]] <= FREE
    x, y = thing.mean(axis=0).tolist()
    reach = ALONE + float(np.hypot(thing[:, 0] - x, thing[:, 1] - y).max())
    is_alone = not (grid.evidence[_about(grid, (x, y), reach)] > 0).any()
    return is_alone and bool(new.mean() > MOST)
