"""An open field with boxes and cylinders in about half of its cells."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from bringup.world.cells import CELL, centre, spread
from bringup.world.shapes import Box, Cylinder, Shape

if TYPE_CHECKING:
    import random
    from collections.abc import Sequence

    from bringup.world.geometry import Pose

OBSTACLE_HEIGHT = 0.8
# Two obstacles of neighbouring cells leave 0.9 m between them: nearly twice a robot.
LARGEST_RADIUS = 0.35
LARGEST_SHIFT = 0.2
START_ROOM = 0.75 * CELL


def fill(side: int, starts: Sequence[Pose], chance: random.Random) -> list[Shape]:
    """Obstacles in every second cell, none near a start pose."""
    cells = [centre(cell, side) for cell in spread(side, chance)]
    free = [cell for cell in cells if all(_apart(cell, start) >= START_ROOM for start in starts)]
    return [
        _obstacle(f"obstacle{number}", cell, chance)
        for number, cell in enumerate(free[: side * side // 2], start=1)
    ]


def _apart(one: Pose, other: Pose) -> float:
    return math.hypot(one.x - other.x, one.y - other.y)


def _obstacle(name: str, cell: Pose, chance: random.Random) -> Shape:
    x = cell.x + chance.uniform(-LARGEST_SHIFT, LARGEST_SHIFT)
    y = cell.y + chance.uniform(-LARGEST_SHIFT, LARGEST_SHIFT)
    if chance.choice((True, False)):
        return Cylinder(name, x, y, chance.uniform(0.15, LARGEST_RADIUS), OBSTACLE_HEIGHT)
    half_x, half_y = (chance.uniform(0.12, LARGEST_RADIUS / math.sqrt(2)) for _ in range(2))
    return Box(name, x, y, half_x, half_y, chance.uniform(-math.pi, math.pi), OBSTACLE_HEIGHT)
