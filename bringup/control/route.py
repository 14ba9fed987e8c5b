"""The way to a place through a grid: one field of distances to it, and the way down that field, made straight.

The field is found by sweeps: a running minimum along all rows, then along all columns, each there and back,
until nothing changes any more. That is the length of ways along rows and columns, weighted by how near they
come to obstacles, and costs numpy a few milliseconds where a queue of cells in Python would stop the loop for
tenths of a second. The stairs of such a way are taken out afterwards.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from bringup.control.costs import CLOSED
from bringup.control.way import Way

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bringup.control.command import Pose
    from bringup.control.costs import Costs
    from bringup.control.grid import Cells, Points

NEVER = 1_000_000_000
# More sweeps than any way of these worlds has turns; a field that still changes then is used as it is.
MOST_SWEEPS = 400
NEIGHBOURS = np.array([(1, 1), (1, -1), (-1, 1), (-1, -1), (0, 1), (0, -1), (1, 0), (-1, 0)])
# A robot that stands too near to something is led out from the nearest open cell, no farther away than this (m).
STEP_OUT = 0.4


def found(priced: Costs, pose: Pose, place: tuple[float, float], tolerance: float) -> Way | None:
    """The way from the robot to within `tolerance` m of a place; None if there is none."""
    cells = descent(priced, beginning(priced, pose), open_about(priced, place, tolerance)[:1])
    if cells is None:
        return None
    corners = straightened(priced, cells)
    if priced.between(np.array(place), np.array(place)) < CLOSED:
        corners[-1] = place
    return Way(corners, priced)


def descent(priced: Costs, start: tuple[int, int] | None, ends: Cells) -> Cells | None:
    """The cells from the start to the nearest of the ends, each beside the one before; None if there is no way."""
    if start is None or not len(ends):
        return None
    field = distances(priced.values, ends, start)
    return None if field[start] >= CLOSED else _down(field, start)


def beginning(priced: Costs, pose: Pose) -> tuple[int, int] | None:
    """The robot's cell, or the nearest open one; None if it is shut in."""
    here = priced.grid.cells(np.array([[pose.x, pose.y]]))
    near = _open(priced, here[0], STEP_OUT)
    return None if not len(near) else (int(near[0, 0]), int(near[0, 1]))


def open_about(priced: Costs, place: tuple[float, float], reach: float) -> Cells:
    """The open cells with their middles within reach (m) of a place, the nearest first."""
    near = _open(priced, priced.grid.cells(np.array([place]))[0], reach + priced.grid.resolution)
    apart = np.hypot(*(priced.grid.centres(near) - place).T)
    order = np.argsort(apart, kind="stable")
    result: Cells = near[order[apart[order] <= reach]]
    return result


def _open(priced: Costs, cell: Cells, reach: float) -> Cells:
    """Open cells within reach of a cell, the nearest first."""
    wide = math.floor(reach / priced.grid.resolution)
    steps = np.mgrid[-wide : wide + 1, -wide : wide + 1].reshape(2, -1).T
    far = np.einsum("ij,ij->i", steps, steps)
    order = np.argsort(far, kind="stable")
    near = cell + steps[order[far[order] <= wide * wide]]
    near = near[priced.grid.inside(near)]
    result: Cells = near[priced.values[near[:, 0], near[:, 1]] < CLOSED]
    return result


def distances(
    price: NDArray[np.int32], ends: Cells, start: tuple[int, int] | None = None
) -> NDArray[np.int32]:
    """What it costs to come from each cell to the nearest of the ends, rows and columns only.

    With a start, only as far as the way from there needs. `CLOSED` or more where there is no way.
    """
    field = np.full(price.shape, NEVER, dtype=np.int32)
    field[ends[:, 0], ends[:, 1]] = 0
    sums = [np.cumsum(price, axis=axis, dtype=np.int32) for axis in (0, 1)]
    for _ in range(MOST_SWEEPS):
        before = field
        for axis in (0, 1):
            field = _swept(field, price, sums[axis], axis)
        bound = CLOSED if start is None else min(CLOSED, int(field[start]) + 1)
        if not ((field != before) & (field < bound)).any():
            break
    return field


def _swept(
    field: NDArray[np.int32], price: NDArray[np.int32], sums: NDArray[np.int32], axis: int
) -> NDArray[np.int32]:
    """The field after all ways along one axis, both ways. A way pays for the cell that it leaves."""
    # From a cell up to a greater index one leaves all cells before that, from there back all after it.
    left = sums - price
    back = np.flip(np.minimum.accumulate(np.flip(field + left, axis), axis), axis) - left
    there = np.minimum.accumulate(field - sums, axis) + sums
    result: NDArray[np.int32] = np.minimum(np.minimum(there, back), NEVER)
    return result


def _down(field: NDArray[np.int32], start: tuple[int, int]) -> Cells:
    """The cells from the start down to where the field is 0, also across corners."""
    padded = np.pad(field, 1, constant_values=NEVER)
    here = np.array(start) + 1
    way = [here]
    while padded[tuple(here)] > 0:
        around = here + NEIGHBOURS
        here = around[int(np.argmin(padded[around[:, 0], around[:, 1]]))]
        way.append(here)
    result: Cells = np.array(way) - 1
    return result


def straightened(priced: Costs, cells: Cells) -> Points:
    """The corners of a way after all that can be cut off without coming nearer to anything than it does."""
    points, dear = priced.grid.centres(cells), priced.values[cells[:, 0], cells[:, 1]]
    corners = [0]
    while corners[-1] < len(points) - 1:
        corners.append(_farthest(priced, points, dear, corners[-1]))
    return points[corners]


def _farthest(priced: Costs, points: Points, dear: NDArray[np.int32], at: int) -> int:
    """The last point that can be reached straight from the one at `at`, found by halving."""
    sure, step = at + 1, 1
    while at + 2 * step < len(points) and _cuts(priced, points, dear, at, at + 2 * step):
        step *= 2
        sure = at + step
    beyond = min(at + 2 * step, len(points) - 1)
    while sure < beyond:
        middle = (sure + beyond + 1) // 2
        if _cuts(priced, points, dear, at, middle):
            sure = middle
        else:
            beyond = middle - 1
    return sure


def _cuts(priced: Costs, points: Points, dear: NDArray[np.int32], start: int, end: int) -> bool:
    return priced.between(points[start], points[end]) <= int(dear[start : end + 1].max())
