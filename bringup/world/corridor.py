"""One long way, as wide as a cell, back and forth through the world, with posts standing along its walls."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from bringup.world.cells import CELL, centre
from bringup.world.shapes import Box, Cylinder, Shape

if TYPE_CHECKING:
    import random
    from collections.abc import Sequence

    from bringup.world.geometry import Pose

WALL_HEIGHT = 0.8
WALL_HALF = 0.05
# The share of the cells in which a post stands; one leaves 1.25 m of the corridor free, a robot needs 0.5 m.
POSTS = 0.3
POST_RADIUS = (0.1, 0.2)
# From the middle of the way to the middle of a post.
POST_SHIFT = (0.65, 0.75)
START_ROOM = 1.2


def fill(side: int, starts: Sequence[Pose], chance: random.Random) -> list[Shape]:
    """The walls between the lanes, each open at one end, and the posts, none near a start pose."""
    walls: list[Shape] = [_wall(lane, side) for lane in range(side - 1)]
    posts = [
        _post(f"post_{column}_{row}", centre((column, row), side), chance)
        for row in range(side)
        for column in range(1, side - 1)
        if chance.random() < POSTS
    ]
    return walls + [post for post in posts if all(_apart(post, start) >= START_ROOM for start in starts)]


def _wall(lane: int, side: int) -> Box:
    """The wall above a lane: it leaves the last cell open, every second one the first cell."""
    one, other = centre((0, lane), side), centre((0, lane + 1), side)
    shift = CELL / 2 if lane % 2 else -CELL / 2
    long = (side - 1) * CELL / 2
    return Box(f"wall_{lane}", shift, (one.y + other.y) / 2, long, WALL_HALF, 0.0, WALL_HEIGHT)


def _post(name: str, cell: Pose, chance: random.Random) -> Cylinder:
    shift = chance.choice((-1, 1)) * chance.uniform(*POST_SHIFT)
    along = chance.uniform(-0.3, 0.3)
    return Cylinder(name, cell.x + along, cell.y + shift, chance.uniform(*POST_RADIUS), WALL_HEIGHT)


def _apart(post: Cylinder, start: Pose) -> float:
    return math.hypot(post.x - start.x, post.y - start.y)
