"""Square worlds are made of square cells: a robot starts in the middle of one, an obstacle keeps to one."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from bringup.world.geometry import Pose

if TYPE_CHECKING:
    import random

CELL = 2.0
SMALLEST_SIDE = 5

Cell = tuple[int, int]


def side_for(robots: int) -> int:
    """Cells along each side of a world in which at least half of the cells stay free of robots."""
    return max(SMALLEST_SIDE, math.ceil(math.sqrt(2 * robots)))


def centre(cell: Cell, side: int) -> Pose:
    """The middle of a cell; the world's own middle is (0, 0)."""
    return Pose((cell[0] - (side - 1) / 2) * CELL, (cell[1] - (side - 1) / 2) * CELL, 0.0)


def spread(side: int, chance: random.Random) -> list[Cell]:
    """All cells of a world, each as far as possible from all before it."""
    rest = [(column, row) for column in range(side) for row in range(side)]
    chance.shuffle(rest)
    chosen = [rest.pop()]
    nearest = {cell: math.dist(cell, chosen[0]) for cell in rest}
    while nearest:
        cell = max(nearest, key=nearest.__getitem__)
        del nearest[cell]
        chosen.append(cell)
        nearest = {other: min(known, math.dist(other, cell)) for other, known in nearest.items()}
    return chosen
