"""What has come to where nothing was a moment ago: other robots, and people.

A scan alone does not tell a robot from a post. The grid of a journey does: where a beam has passed and now something
stands, something has come there. Things are followed from scan to scan, so that one that creeps is noticed as well,
and one that stands again is not forgotten.
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
# Evidence of cells that were seen free for sure, and at all, and how far (m) they are from all that was seen in them.
FREE, SEEN_FREE, ALONE = -4, -1, 0.2
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

    `stands` is where it was when it last moved on, and when that was. What has not come to where nothing was does
    not move as far as anybody knows.
    """

    x: float
    y: float
    vx: float
    vy: float
    at: float
    number: int
    stands: tuple[float, float, float]
    moves: bool = True


def followed(
    movers: tuple[Mover, ...], grid: Grid, eye: Pose, points: Points, now: float
) -> tuple[Mover, ...]:
    """What is no wall after a scan, its points in the frame of the robot at `eye`; `grid` is without it."""
    close = points[np.einsum("ij,ij->i", points, points) < WATCHED * WATCHED]
    left = [each for each in movers if 0.0 <= now - each.at < LOST]
    result: list[Mover] = []
    number = 1 + max((each.number for each in movers), default=0)
    for thing in _things(world(eye, close)):
        middle = _middle(thing, eye)
        last = min(left, key=lambda each: math.hypot(each.x - middle[0], each.y - middle[1]), default=None)
        has_come = _is_new(grid, thing, FREE) and _is_alone(grid, thing)
        if last is not None and math.hypot(last.x - middle[0], last.y - middle[1]) < STEP:
            left.remove(last)
            moved = _moved(last, middle, now, is_new=_is_new(grid, thing, SEEN_FREE))
            result.append(replace(moved, moves=moved.moves or has_come))
        else:
            result.append(Mover(*middle, 0.0, 0.0, now, number, (*middle, now), has_come))
            number += 1
    return (*result, *left)


def without(grid: Grid, movers: tuple[Mover, ...], before: tuple[Mover, ...]) -> Grid:
    """The grid without what moves; of what did not `before` also without where it seems to have stood till then."""
    if not movers:
        return grid
    evidence = grid.evidence.copy()
    known = {each.number for each in before if each.moves}
    for each in movers:
        if not each.moves:
            continue
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


def _moved(last: Mover, middle: tuple[float, float], now: float, *, is_new: bool) -> Mover:
    elapsed = now - last.at
    if elapsed <= 0.0:
        return last
    vx, vy = ((new - old) / elapsed for new, old in zip(middle, (last.x, last.y), strict=True))
    vx, vy = last.vx + NEWEST * (vx - last.vx), last.vy + NEWEST * (vy - last.vy)
    x, y, _ = last.stands
    stays = math.dist(middle, (x, y)) < STILL
    stands = last.stands if stays else (*middle, now)
    return Mover(*middle, vx, vy, now, last.number, stands, last.moves or (is_new and not stays))


def _is_new(grid: Grid, thing: Points, evidence: int) -> bool:
    """Whether most of a thing stands where there was no more evidence than this."""
    cells = grid.cells(thing)
    cells = cells[grid.inside(cells)]
    return bool(len(cells)) and bool((grid.evidence[cells[:, 0], cells[:, 1]] <= evidence).mean() > MOST)


def _is_alone(grid: Grid, thing: Points) -> bool:
    """Whether a thing stands away from all that was there."""
    x, y = thing.mean(axis=0).tolist()
    reach = ALONE + float(np.hypot(thing[:, 0] - x, thing[:, 1] - y).max())
    return not (grid.evidence[_about(grid, (x, y), reach)] > 0).any()
