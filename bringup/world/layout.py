"""Which walls, obstacles and start poses a world has; all of it comes from one seed."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

from bringup.world import arena, corridor, maze, warehouse
from bringup.world.body import FOOTPRINT_RADIUS
from bringup.world.cells import CELL, centre, side_for, spread
from bringup.world.geometry import Pose
from bringup.world.shapes import Box, Shape, distance

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

WORLDS: dict[str, Callable[[int, Sequence[Pose], random.Random], list[Shape]]] = {
    "arena": arena.fill,
    "maze": maze.fill,
    "corridor": corridor.fill,
    "warehouse": warehouse.fill,
}
WALL_HALF = 0.1
WALL_HEIGHT = 1.0
SIDES = (0.0, math.pi / 2, math.pi, -math.pi / 2)
LOOK_STEP = 0.2


class LayoutError(ValueError):
    """A world cannot be made as asked; the message says why."""


@dataclass(frozen=True, slots=True)
class Start:
    """A robot and where it stands at first, in world coordinates."""

    robot: str
    pose: Pose


@dataclass(frozen=True, slots=True)
class Layout:
    """Everything a world is made of. `half` is the distance in metres from the middle to an outer wall's face."""

    name: str
    seed: int
    half: float
    walls: tuple[Box, ...]
    obstacles: tuple[Shape, ...]
    starts: tuple[Start, ...]


def lay_out(world: str, seed: int, robots: Sequence[str], start_poses: Sequence[Pose | None] = ()) -> Layout:
    """Lay out a world; the same arguments always give the same one. A start pose that is None is found.

    Raises LayoutError: no such world, not one start pose per robot, a start pose without room for the robot.
    """
    if world not in WORLDS:
        raise LayoutError(f"no world is called '{world}'; there are {', '.join(WORLDS)}")
    if start_poses and len(start_poses) != len(robots):
        raise LayoutError(f"{len(start_poses)} start poses for {len(robots)} robots")
    chance = random.Random(f"{world} {seed}")
    side = side_for(len(robots))
    half = side * CELL / 2
    given = list(start_poses) or [None] * len(robots)
    free = _free(given, side, chance)
    places = [pose or next(free) for pose in given]
    obstacles = tuple(WORLDS[world](side, places, chance))
    made = Layout(world, seed, half, _outer_walls(half), obstacles, starts=())
    poses = [pose or _facing_room(made, place) for pose, place in zip(given, places, strict=True)]
    starts = tuple(Start(robot, pose) for robot, pose in zip(robots, poses, strict=True))
    _require_room(made, starts)
    return Layout(world, seed, half, made.walls, obstacles, starts)


def room(layout: Layout, x: float, y: float) -> float:
    """Metres from a point to the nearest wall or obstacle, negative inside one or outside the world."""
    inside = layout.half - max(abs(x), abs(y))
    return min([inside, *(distance(shape, x, y) for shape in layout.obstacles)])


def _free(given: Sequence[Pose | None], side: int, chance: random.Random) -> Iterator[Pose]:
    """Places to start from, far apart and none beside a start pose that is given.

    There are enough: a start pose takes two cells at most, and a world has two for each robot.
    """
    taken = [pose for pose in given if pose]
    for cell in spread(side, chance):
        place = centre(cell, side)
        if all(math.hypot(place.x - pose.x, place.y - pose.y) > CELL / 2 for pose in taken):
            yield place


def _outer_walls(half: float) -> tuple[Box, ...]:
    middle, long = half + WALL_HALF, half + 2 * WALL_HALF
    return (
        Box("wall_east", middle, 0.0, WALL_HALF, long, 0.0, WALL_HEIGHT),
        Box("wall_west", -middle, 0.0, WALL_HALF, long, 0.0, WALL_HEIGHT),
        Box("wall_north", 0.0, middle, long, WALL_HALF, 0.0, WALL_HEIGHT),
        Box("wall_south", 0.0, -middle, long, WALL_HALF, 0.0, WALL_HEIGHT),
    )


def _facing_room(layout: Layout, pose: Pose) -> Pose:
    """The same place, turned to that one of the four sides where the way is longest free."""
    return Pose(pose.x, pose.y, max(SIDES, key=lambda yaw: _way(layout, pose, yaw)))


def _way(layout: Layout, pose: Pose, yaw: float) -> float:
    way = 0.0
    while room(layout, pose.x + way * math.cos(yaw), pose.y + way * math.sin(yaw)) > FOOTPRINT_RADIUS:
        way += LOOK_STEP
    return way


def _require_room(layout: Layout, starts: Sequence[Start]) -> None:
    for start in starts:
        # Written so that a pose that is no number has no room either.
        if not room(layout, start.pose.x, start.pose.y) > FOOTPRINT_RADIUS:
            raise LayoutError(
                f"{start.robot} cannot start at x {start.pose.x:g}, y {start.pose.y:g}: "
                f"that is in or outside of the walls and obstacles of '{layout.name}'"
            )
    for one, other in combinations(starts, 2):
        if math.hypot(one.pose.x - other.pose.x, one.pose.y - other.pose.y) <= 2 * FOOTPRINT_RADIUS:
            raise LayoutError(f"{one.robot} and {other.robot} would start inside one another")
