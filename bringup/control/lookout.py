"""Where to look before a goal is given up: what seems shut from afar may be open.

From afar a small error of the heading puts a wall into the wrong cells, and a robot that was seen once in a
passage stays in the grid when it has gone. So where no way leads to a goal, one is planned for a robot that is
hardly wider than a beam, and driven as far as the real one can go. What is still shut there after a while is
shut. To forget the whole grid instead was tried: robots went through a maze twice before they gave up a goal
outside of it, and gave up goals in the open that were seen from afar only.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bringup.control.costs import CLOSED, TIGHT, Costs, near, squared_distances
from bringup.control.route import beginning, descent, open_about, straightened
from bringup.control.way import Way, remaining

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bringup.control.command import Pose

# Radius (m) of the robot that comes through whatever is not shut for certain.
THIN = 0.1
# From this near (m) to a goal one sees whether there is room at it.
BESIDE_GOAL = 0.35
# A place has been looked at after so many seconds this near (m) to the end of the way to it.
LOOK, NEAR = 3.0, 0.25
# A place that closes while the robot comes near to it is shut, too, when the robot sees that from no farther (m).
IN_SIGHT = 2.5
# What lies this near (m) to a place that was looked at has been looked at as well.
ABOUT = 0.5


@dataclass(frozen=True, slots=True)
class Doubt:
    """A place in m that seems shut, how to come near, and since when the robot has been looking at it."""

    x: float
    y: float
    way: Way
    since: float | None = None


@dataclass(frozen=True, slots=True)
class Lookout:
    """Places that were looked at and are shut, and the one to look at now."""

    shut: tuple[tuple[float, float], ...] = ()
    doubt: Doubt | None = None


def looked(lookout: Lookout, priced: Costs, pose: Pose, place: tuple[float, float], now: float) -> Lookout:
    """The lookout with the next place to look at on the way to a goal; without one when all was looked at."""
    last = lookout.doubt
    if last is not None and last.since is not None and now - last.since > LOOK:
        lookout, last = _seen_shut(lookout, last, place), None
    new = _doubt(priced, pose, place, lookout.shut)
    same = last is not None and new is not None and math.hypot(last.x - new.x, last.y - new.y) < ABOUT
    if last is not None and not same and pose.distance(last.x, last.y) < IN_SIGHT:
        lookout = _seen_shut(lookout, last, place)
    if new is None or remaining(new.way, pose) > NEAR:
        return replace(lookout, doubt=new)
    since = last.since if last is not None and same and last.since is not None else now
    return replace(lookout, doubt=replace(new, since=since))


def _seen_shut(lookout: Lookout, last: Doubt, place: tuple[float, float]) -> Lookout:
    """The lookout after a place was looked at. Who has looked beside the goal has looked at it, also in a wall."""
    beside = math.hypot(last.x - place[0], last.y - place[1]) < ABOUT
    return Lookout((*lookout.shut, (last.x, last.y), *([place] if beside else [])))


def is_looking(lookout: Lookout) -> bool:
    """Whether the robot is where it looks from, and stands."""
    return lookout.doubt is not None and lookout.doubt.since is not None


def _doubt(
    priced: Costs, pose: Pose, place: tuple[float, float], shut: tuple[tuple[float, float], ...]
) -> Doubt | None:
    """The first place on a thin robot's way that is too tight for the real one, or the end if there is none."""
    known = np.zeros(priced.values.shape, dtype=np.bool_)
    for each in shut:
        known |= near(priced.grid, each, ABOUT)
    thin = _thin(priced, known)
    ends = open_about(thin, place, BESIDE_GOAL)
    cells = descent(thin, beginning(priced, pose), ends[~known[ends[:, 0], ends[:, 1]]])
    if cells is None:
        return None
    tight = np.flatnonzero(priced.values[cells[:, 0], cells[:, 1]] >= CLOSED)
    beyond = int(tight[0]) if len(tight) else len(cells)
    x, y = priced.grid.centres(cells)[min(beyond, len(cells) - 1)].tolist()
    return Doubt(x, y, Way(straightened(priced, cells[:beyond]), priced))


def _thin(priced: Costs, known: NDArray[np.bool_]) -> Costs:
    """What a thin robot pays: as the real one where that one can be, much where it cannot, unless that is known."""
    reach = THIN / priced.grid.resolution
    room = squared_distances(priced.grid.occupied, math.ceil(reach)) > reach * reach
    closed = priced.values >= CLOSED
    values = np.where(closed, np.where(room & ~known, TIGHT, CLOSED), priced.values)
    return Costs(priced.grid, values.astype(np.int32))
