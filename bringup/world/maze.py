"""Corridors one cell wide; every cell can be reached, mostly in more than one way."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bringup.world.cells import CELL, Cell, centre
from bringup.world.shapes import Box, Shape

if TYPE_CHECKING:
    import random
    from collections.abc import Sequence

    from bringup.world.geometry import Pose

WALL_HEIGHT = 0.8
WALL_HALF = 0.05
# The share of walls that a second walk takes away, so that there are ways around and not only dead ends.
LOOPS = 0.2

Edge = tuple[Cell, Cell]


def fill(side: int, _starts: Sequence[Pose], chance: random.Random) -> list[Shape]:
    """The inner walls."""
    return [_wall(edge, side) for edge in sorted(closed_edges(side, chance)) if chance.random() >= LOOPS]


def closed_edges(side: int, chance: random.Random) -> set[Edge]:
    """Borders between neighbours that one depth-first walk over all cells never crosses."""
    closed = _all_edges(side)
    seen: set[Cell] = {(0, 0)}
    path: list[Cell] = [(0, 0)]
    while path:
        here = path[-1]
        ahead = [cell for cell in _neighbours(here, side) if cell not in seen]
        if not ahead:
            path.pop()
            continue
        there = chance.choice(ahead)
        closed.discard((min(here, there), max(here, there)))
        seen.add(there)
        path.append(there)
    return closed


def _all_edges(side: int) -> set[Edge]:
    cells = [(column, row) for column in range(side) for row in range(side)]
    return {(cell, other) for cell in cells for other in _neighbours(cell, side) if cell < other}


def _neighbours(cell: Cell, side: int) -> list[Cell]:
    column, row = cell
    steps = [(column + 1, row), (column, row + 1), (column - 1, row), (column, row - 1)]
    return [step for step in steps if min(step) >= 0 and max(step) < side]


def _wall(edge: Edge, side: int) -> Box:
    one, other = (centre(cell, side) for cell in edge)
    x, y = (one.x + other.x) / 2, (one.y + other.y) / 2
    name = "wall_{}_{}_{}_{}".format(*edge[0], *edge[1])
    long = CELL / 2 + WALL_HALF
    if one.y == other.y:
        return Box(name, x, y, WALL_HALF, long, 0.0, WALL_HEIGHT)
    return Box(name, x, y, long, WALL_HALF, 0.0, WALL_HEIGHT)
