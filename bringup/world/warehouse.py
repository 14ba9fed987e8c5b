"""Rows of shelves with aisles between them, cross aisles, and pallets left standing beside the shelves."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from bringup.world.cells import CELL, centre
from bringup.world.shapes import Box, Shape

if TYPE_CHECKING:
    import random
    from collections.abc import Sequence

    from bringup.world.geometry import Pose

SHELF_HEIGHT = 1.2
PALLET_HEIGHT = 0.8
# Half the depth of two shelves back to back: the aisles between them are 1.5 m wide.
SHELF_HALF = 0.25
# One of so many columns of cells is a cross aisle, in which no shelf stands.
BLOCK = 3
# The share of shelves that are missing, and of cells with a pallet.
GAPS = 0.1
PALLETS = 0.25
PALLET_HALF = (0.12, 0.2)
START_ROOM = 1.2


def fill(side: int, starts: Sequence[Pose], chance: random.Random) -> list[Shape]:
    """Shelves between every two rows of cells; pallets in front of them, none near a start pose."""
    first = chance.randrange(BLOCK)
    columns = [column for column in range(side) if column % BLOCK != first]
    shelves: list[Shape] = [
        _shelf(column, row, side) for row in range(side - 1) for column in columns if chance.random() >= GAPS
    ]
    pallets = [
        _pallet(f"pallet_{column}_{row}", centre((column, row), side), chance)
        for row in range(side)
        for column in columns
        if chance.random() < PALLETS
    ]
    return shelves + [
        pallet for pallet in pallets if all(_apart(pallet, start) >= START_ROOM for start in starts)
    ]


def _shelf(column: int, row: int, side: int) -> Box:
    below, above = centre((column, row), side), centre((column, row + 1), side)
    middle = (below.y + above.y) / 2
    return Box(f"shelf_{column}_{row}", below.x, middle, CELL / 2, SHELF_HALF, 0.0, SHELF_HEIGHT)


def _pallet(name: str, cell: Pose, chance: random.Random) -> Box:
    """A pallet at the edge of the aisle: it leaves more than a metre beside it."""
    half_x, half_y = chance.uniform(*PALLET_HALF), chance.uniform(*PALLET_HALF)
    edge = CELL / 2 - SHELF_HALF - half_y
    along = chance.uniform(-0.5, 0.5)
    return Box(
        name, cell.x + along, cell.y + chance.choice((-edge, edge)), half_x, half_y, 0.0, PALLET_HEIGHT
    )


def _apart(pallet: Box, start: Pose) -> float:
    return math.hypot(pallet.x - start.x, pallet.y - start.y)
