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

# What a cell costs: far from obstacles, and where it is nearer to one than the robot's radius and each of these (m).
FREE = 1
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
    occupied = grid.occupied
    values = np.full(occupied.shape, FREE, dtype=np.int32)
    for width, price in NARROW:
        values[widened(occupied, (radius + width) / grid.resolution)] = price
    values[widened(occupied, radius / grid.resolution)] = CLOSED
    return Costs(grid, values)


def widened(cells: NDArray[np.bool_], radius: float) -> NDArray[np.bool_]:
    """All cells that have a marked one within so many cells."""
    result = np.zeros_like(cells)
    for row in range(-math.floor(radius), math.floor(radius) + 1):
        half = math.floor(math.sqrt(radius * radius - row * row))
        line = _spread(cells, half)
        if row >= 0:
            result[row:] |= line[: len(line) - row]
        else:
            result[:row] |= line[-row:]
    return result


def _spread(cells: NDArray[np.bool_], half: int) -> NDArray[np.bool_]:
    """Each row's marks widened to both sides."""
    wide = np.pad(cells, ((0, 0), (half + 1, half)))
    sums = np.cumsum(wide, axis=1, dtype=np.int32)
    result: NDArray[np.bool_] = sums[:, 2 * half + 1 :] > sums[:, : -2 * half - 1]
    return result
