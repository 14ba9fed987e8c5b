"""Where two robots cannot pass each other one goes back and lets the other one by.

Each has some patience with what moves and is in its way. Whose patience ends first goes to a place where another
robot can come by, and waits there. How long it is patient comes from its name and from how often it has given way,
so that no two robots wait for each other, or give way to each other, for ever. A thing that has not moved when the
robot comes back does not move: it is an obstacle like any other.
"""

from __future__ import annotations

import math
import random
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bringup.control.costs import CLOSED, Costs
from bringup.control.movers import STILL
from bringup.control.route import beginning, distances

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bringup.control.command import Pose
    from bringup.control.movers import Mover
    from bringup.control.way import Way

# Seconds of patience, at least and at most: where there is no way but through others, and where there is one.
PATIENCE, PATIENCE_PASSING = (1.5, 5.0), (5.0, 9.0)
# What moves nearer (m) than this is what keeps the robot from getting on.
IN_THE_WAY = 1.6
# Places to wait at: so near and so far (m), so far apart, so many of them, and so far (m) from what is let by.
REACH, APART, MOST, DISTANCE = 4.0, 0.25, 40, 1.2
# About such a place another robot finds its way within this radius (m), so near (m) to this one: the first if possible.
AROUND, BESIDE = 1.3, (0.66, 0.52)
# The share of the room about it that is still in one piece then.
WHOLE = 0.8
# Seconds that a robot waits at most, and at least.
LONGEST, SHORTEST = 12.0, 1.0
# Who has passed is no more so near (m) to the first part (m) of the way.
PASSED_BY, AHEAD = 0.8, 3.5
# What has not moved for so many seconds, although it was given way, is parked.
PARKED = 20.0
# How often a robot gives way.
MOST_TIMES = 4


@dataclass(frozen=True, slots=True)
class Giving:
    """The place in m where the robot lets others by, and since when it has been there."""

    x: float
    y: float
    since: float | None = None


@dataclass(frozen=True, slots=True)
class Courtesy:
    """How often the robot has given way, when it last tried, where it does so now, and what is parked.

    `stands` is where the robot was when it last moved on, and when that was.
    """

    times: int = 0
    tried: float = -math.inf
    stands: tuple[float, float, float] = (math.nan, math.nan, -math.inf)
    giving: Giving | None = None
    parked: tuple[tuple[float, float], ...] = ()


def told_apart(courtesy: Courtesy, movers: tuple[Mover, ...]) -> tuple[tuple[Mover, ...], tuple[Mover, ...]]:
    """What moves, and of that what has turned out to be parked."""
    movers = tuple(each for each in movers if each.moves)
    parked = tuple(
        each for each in movers if any(math.hypot(each.x - x, each.y - y) < STILL for x, y in courtesy.parked)
    )
    return tuple(each for each in movers if each not in parked), parked


def is_waiting(courtesy: Courtesy) -> bool:
    """Whether the robot is where it lets others by, and stands."""
    return courtesy.giving is not None and courtesy.giving.since is not None


def in_the_way(movers: tuple[Mover, ...], pose: Pose) -> tuple[Mover, ...]:
    """The movers that are so near that they may keep the robot from getting on."""
    return tuple(each for each in movers if pose.distance(each.x, each.y) < IN_THE_WAY)


def moved_on(courtesy: Courtesy, pose: Pose, now: float) -> Courtesy:
    """The courtesy after a look at where the robot has come."""
    x, y, _ = courtesy.stands
    return courtesy if pose.distance(x, y) < STILL else replace(courtesy, stands=(pose.x, pose.y, now))


def is_impatient(
    courtesy: Courtesy, movers: tuple[Mover, ...], seed: int, now: float, *, waits: bool
) -> bool:
    """Whether a robot of this seed gives way now, to movers that are in its way; `waits` if it has no other way."""
    if courtesy.giving is not None or not movers or courtesy.times >= MOST_TIMES:
        return False
    since = max(courtesy.tried, courtesy.stands[2], *(each.stands[2] for each in movers))
    return now - since > patience(seed, courtesy.times, PATIENCE if waits else PATIENCE_PASSING)


def patience(seed: int, times: int, limits: tuple[float, float]) -> float:
    """Seconds for which a robot of this seed, which has given way so often, waits for others."""
    return random.Random(f"{seed}/{times}").uniform(*limits)


def begun(
    courtesy: Courtesy, priced: Costs, fixed: Costs, pose: Pose, others: tuple[Mover, ...], now: float
) -> Courtesy:
    """The courtesy with a place to wait at, if there is one; `fixed` are the costs without anything that moves."""
    place = _place(priced, fixed, pose, others)
    giving = None if place is None else Giving(*place)
    return replace(courtesy, times=courtesy.times + 1, tried=now, giving=giving)


def is_over(
    courtesy: Courtesy, movers: tuple[Mover, ...], way: Way | None, pose: Pose, seed: int, now: float
) -> bool:
    """Whether the robot goes on: others have passed its way, or it has waited long enough."""
    giving = courtesy.giving
    if giving is None or giving.since is None or now - giving.since < SHORTEST:
        return False
    if now - giving.since > LONGEST or way is None or not _is_beside(way, pose, movers):
        return True
    since = max(giving.since, *(each.stands[2] for each in movers))
    return now - since > patience(seed, courtesy.times, PATIENCE)


def finished(courtesy: Courtesy, movers: tuple[Mover, ...], now: float) -> Courtesy:
    """The courtesy after the robot has waited."""
    parked = [each.stands[:2] for each in movers if now - each.stands[2] > PARKED]
    return replace(courtesy, parked=(*courtesy.parked, *parked), giving=None, tried=now)


def _is_beside(way: Way, pose: Pose, movers: tuple[Mover, ...]) -> bool:
    """Whether anything that moves is near the first part of a way."""
    corners = np.concatenate(([[pose.x, pose.y]], way.corners))
    lengths = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(corners, axis=0).T))))
    steps = np.arange(0.0, min(AHEAD, float(lengths[-1])) + 0.1, 0.1)
    xs, ys = np.interp(steps, lengths, corners[:, 0]), np.interp(steps, lengths, corners[:, 1])
    return any(bool((np.hypot(xs - each.x, ys - each.y) < PASSED_BY).any()) for each in movers)


def _place(priced: Costs, fixed: Costs, pose: Pose, others: tuple[Mover, ...]) -> tuple[float, float] | None:
    """The nearest place where others can come by."""
    start = beginning(priced, pose)
    if start is None:
        return None
    grid = priced.grid
    wide = math.ceil(REACH / grid.resolution)
    low, left = max(0, start[0] - wide), max(0, start[1] - wide)
    window = (slice(low, start[0] + wide + 1), slice(left, start[1] + wide + 1))
    field = distances(priced.values[window], np.array([[start[0] - low, start[1] - left]]))
    step = max(1, round(APART / grid.resolution))
    rows, columns = np.mgrid[0 : field.shape[0] : step, 0 : field.shape[1] : step].reshape(2, -1)
    cells = np.column_stack((rows, columns))[np.argsort(field[rows, columns], kind="stable")]
    cells = cells[field[cells[:, 0], cells[:, 1]] < CLOSED] + (low, left)
    places = grid.centres(cells)
    for each in others:
        far = np.hypot(*(places - (each.x, each.y)).T) > DISTANCE
        cells, places = cells[far], places[far]
    for beside in BESIDE:
        for cell, (x, y) in zip(cells[:MOST].tolist(), places[:MOST].tolist(), strict=True):
            if _leaves_room(fixed, cell, beside):
                return x, y
    return None


def _leaves_room(fixed: Costs, cell: list[int], beside: float) -> bool:
    """Whether the room about a cell stays in one piece when a robot stands there, and nobody comes so near to it."""
    row, column = cell
    wide = round(AROUND / fixed.grid.resolution)
    low, left = max(0, row - wide), max(0, column - wide)
    part = fixed.values[low : row + wide + 1, left : column + wide + 1]
    rows, columns = np.ogrid[: part.shape[0], : part.shape[1]]
    away = np.hypot(rows - (row - low), columns - (column - left)) * fixed.grid.resolution
    around = (part < CLOSED) & (away < AROUND)
    around = _piece(around, (row - low, column - left))
    rest = around & (away > beside)
    total = int(rest.sum())
    for _ in range(2):
        if rest.sum() < WHOLE * total or not rest.any():
            return False
        piece = _piece(around & (away > beside), tuple(np.argwhere(rest)[0].tolist()))
        if piece.sum() >= WHOLE * total:
            return True
        rest &= ~piece
    return False


def _piece(cells: NDArray[np.bool_], start: tuple[int, int]) -> NDArray[np.bool_]:
    """Those of the marked cells that hang together with one of them."""
    price = np.where(cells, 1, CLOSED).astype(np.int32)
    return cells & (distances(price, np.array([start])) < CLOSED)
