"""How robots pass each other: each keeps to its right.

Nothing is agreed on beforehand and nothing is said: robots know of each other only what their lidars show. Traffic
on the right breaks the symmetry of two that meet, which would else turn aside to the same side, and back again.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from bringup.control.costs import CLOSED, Costs, costs, near

if TYPE_CHECKING:
    from bringup.control.command import Pose
    from bringup.control.grid import Cells, Grid
    from bringup.control.movers import Mover

# What of a mover is kept clear of, besides the robot's own radius and room (m).
BODY = 0.15
# Movers that are nearer (m) are passed on the right, unless they drive away faster than this (m/s).
MEETING, AWAY = 3.0, 0.15
# How far (rad) aside a mover is no more ahead.
AHEAD = 1.2
# One that comes as fast goes to its right as well: so much (m) at most, a share of the distance beyond the last (m).
MAKES_ROOM, SHARE, AT_ONCE = 0.4, 0.3, 1.0
# It is dear to cross the line (m) to the left of a mover: what a cell there costs more.
FENCE, DEAR = 1.5, 60


def among(grid: Grid, standing: tuple[Mover, ...], radius: float) -> Costs:
    """What a robot of this radius pays for each cell among fixed things, and what has come and stays."""
    return costs(_with(grid, [(each.x, each.y) for each in standing]), radius)


def meeting(
    grid: Grid, movers: tuple[Mover, ...], standing: tuple[Mover, ...], pose: Pose, radius: float
) -> Costs:
    """The same among what moves as well; it is passed on the right."""
    places = [(each.x, each.y) for each in standing]
    dear = np.zeros(grid.evidence.shape, dtype=np.bool_)
    for each in movers:
        place = np.array([each.x, each.y])
        comes = _comes(each, pose)
        if comes > -AWAY and _is_ahead(each, pose):
            apart = pose.distance(each.x, each.y)
            left = np.array([pose.y - each.y, each.x - pose.x]) / max(apart, BODY)
            if comes > AWAY:
                place += left * max(0.0, min(MAKES_ROOM, SHARE * (apart - AT_ONCE)))
            cells = _fence(grid, place, left)
            dear[cells[:, 0], cells[:, 1]] = True
        places.append((float(place[0]), float(place[1])))
    priced = costs(_with(grid, places), radius)
    values = np.where(dear & (priced.values < CLOSED), priced.values + DEAR, priced.values)
    return Costs(priced.grid, values)


def _with(grid: Grid, places: list[tuple[float, float]]) -> Grid:
    """The grid with bodies at these places."""
    if not places:
        return grid
    evidence = grid.evidence.copy()
    for place in places:
        evidence[near(grid, place, BODY)] = 1
    return replace(grid, evidence=evidence)


def _is_ahead(mover: Mover, pose: Pose) -> bool:
    return pose.distance(mover.x, mover.y) < MEETING and abs(pose.bearing(mover.x, mover.y)) < AHEAD


def _comes(mover: Mover, pose: Pose) -> float:
    """How fast a mover comes towards the robot in m/s; less than 0 where it drives away."""
    apart = max(pose.distance(mover.x, mover.y), BODY)
    return ((pose.x - mover.x) * mover.vx + (pose.y - mover.y) * mover.vy) / apart


def _fence(grid: Grid, place: np.ndarray, left: np.ndarray) -> Cells:
    """Cells on the line from a place to the left, three of them abreast."""
    step = grid.resolution / 2.0
    along = np.arange(0.0, FENCE, step)[:, np.newaxis] * left
    across = (
        np.array([-2.0, -1.0, 0.0, 1.0, 2.0])[:, np.newaxis, np.newaxis]
        * step
        * np.array([left[1], -left[0]])
    )
    cells = grid.cells((place + along + across).reshape(-1, 2))
    result: Cells = cells[grid.inside(cells)]
    return result
