"""What it costs a robot to be in each cell of a grid: closed where it would touch, dear where it is tight."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bringup.control.grid import Grid

if TYPE_CHECKING:
    from bringup.control.grid import Points

# What a cell costs: far from obstacles, where only a goal's own place is that tight (more than any way around), and
# where it is nearer to one than the robot's radius and each of these (m).
FREE = 1
TIGHT = 200
NARROW = ((0.30, 2), (0.15, 5), (0.05, 20))
# A cell that cannot be entered costs more than any way; int32 holds the sum of a thousand rows of them.
CLOSED = 500_000


@dataclass(frozen=True, slots=True)
class Costs:
    """What it costs to enter each cell of a grid."""

    grid: Grid
    values: NDArray[np.int32]

    def between(self, start: Points, end: Points) -> int:
        """The dearest cell on a straight line; outside of the grid nothing is known to be in the way."""
        length = float(np.hypot(*(end - start)))
        shares = np.linspace(0.0, 1.0, math.ceil(2.0 * length / self.grid.resolution) + 1)
        cells = self.grid.cells(start + shares[:, np.newaxis] * (end - start))
        cells = cells[self.grid.inside(cells)]
        return int(self.values[cells[:, 0], cells[:, 1]].max(initial=FREE))


def costs(grid: Grid, radius: float) -> Costs:
    """What a robot of this radius (m) pays for each cell."""
    widths = [(radius + width, price) for width, price in NARROW] + [(radius, CLOSED)]
    most = max(width for width, _ in widths) / grid.resolution
    squares = squared_distances(grid.occupied, math.ceil(most))
    values = np.full(squares.shape, FREE, dtype=np.int32)
    for width, price in widths:
        values[squares <= (width / grid.resolution) ** 2] = price
    return Costs(grid, values)


def eased(priced: Costs, radius: float, place: tuple[float, float], reach: float) -> Costs | None:
    """The costs for a robot of this lesser radius (m) within reach (m) of a place; None if it gains nothing there.

    What it gains is dear.
    """
    grid, wide = priced.grid, radius / priced.grid.resolution
    ((row, column),) = grid.cells(np.array([place])).tolist()
    most = math.ceil(wide + reach / grid.resolution)
    there = (slice(max(0, row - most), row + most + 1), slice(max(0, column - most), column + most + 1))
    room = squared_distances(grid.occupied[there], math.ceil(wide)) > wide * wide
    gained = (priced.values[there] >= CLOSED) & room & near(grid, place, reach)[there]
    if not gained.any():
        return None
    values = priced.values.copy()
    values[there][gained] = TIGHT
    return Costs(grid, values)


def near(grid: Grid, place: tuple[float, float], reach: float) -> NDArray[np.bool_]:
    """Which cells lie within reach (m) of a place."""
    rows, columns = np.ogrid[: grid.evidence.shape[0], : grid.evidence.shape[1]]
    ((row, column),) = grid.cells(np.array([place])).tolist()
    result: NDArray[np.bool_] = np.hypot(rows - row, columns - column) <= reach / grid.resolution
    return result


def squared_distances(cells: NDArray[np.bool_], most: int) -> NDArray[np.int16]:
    """From each cell to the nearest marked one, in cells, squared; right up to `most` cells, and more than that beyond.

    Along the rows first, then the least over all rows that are near enough (P. Felzenszwalb and D. Huttenlocher,
    "Distance transforms of sampled functions", 2012, which finds that least in another way).
    """
    along = np.minimum(_steps(cells, most), _steps(cells[:, ::-1], most)[:, ::-1]) ** 2
    result = along.copy()
    for rows in range(1, min(most, len(cells) - 1) + 1):
        np.minimum(result[rows:], along[:-rows] + rows * rows, out=result[rows:])
        np.minimum(result[:-rows], along[rows:] + rows * rows, out=result[:-rows])
    return result


def _steps(cells: NDArray[np.bool_], most: int) -> NDArray[np.int16]:
    """From each cell back along its row to a marked one, but no farther than to the first one out of reach."""
    columns = np.arange(cells.shape[1], dtype=np.int32)
    last = np.maximum.accumulate(np.where(cells, columns, -most - 1), axis=1)
    return np.minimum(columns - last, most + 1).astype(np.int16)
