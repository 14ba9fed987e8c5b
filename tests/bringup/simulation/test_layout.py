import math
import random
from itertools import combinations

import pytest

from bringup.world.arena import LARGEST_RADIUS, LARGEST_SHIFT
from bringup.world.body import FOOTPRINT_RADIUS
from bringup.world.cells import CELL
from bringup.world.drive import STILL
from bringup.world.geometry import Pose
from bringup.world.layout import WORLDS, Layout, LayoutError, lay_out, room
from bringup.world.maze import closed_edges
from bringup.world.model import load, pose
from bringup.world.shapes import Box, Cylinder, distance
from bringup.world.simulation import Simulation

SEEDS = range(60)


def names(count: int) -> list[str]:
    return [f"robot{number}" for number in range(1, count + 1)]


@pytest.mark.parametrize("world", WORLDS)
@pytest.mark.parametrize(("robots", "seeds"), [(1, 60), (2, 60), (5, 20), (16, 5)])
def test_every_robot_starts_with_room_to_turn_and_a_way_ahead(world: str, robots: int, seeds: int) -> None:
    for seed in range(seeds):
        layout = lay_out(world, seed, names(robots))
        for start in layout.starts:
            here = start.pose
            assert room(layout, here.x, here.y) > 2 * FOOTPRINT_RADIUS
            ahead = here.x + math.cos(here.yaw), here.y + math.sin(here.yaw)
            assert room(layout, *ahead) > FOOTPRINT_RADIUS
        for one, other in combinations(layout.starts, 2):
            assert math.dist((one.pose.x, one.pose.y), (other.pose.x, other.pose.y)) >= CELL


@pytest.mark.parametrize("world", WORLDS)
@pytest.mark.parametrize("seed", range(4))
def test_every_world_loads_and_stands_still(world: str, seed: int) -> None:
    """A robot that has started inside something would be thrown out by the physics."""
    simulation = Simulation(load(lay_out(world, seed, names(3))))
    for _ in range(20):
        simulation.tick([STILL] * 3)
    for robot in simulation.model.robots:
        here = pose(simulation.data, robot)
        assert math.dist((here.x, here.y), (robot.start.x, robot.start.y)) < 0.001
    assert [count.episodes for count in simulation.contacts] == [0, 0, 0]


def test_a_seed_is_a_world() -> None:
    assert lay_out("arena", 7, names(2)) == lay_out("arena", 7, names(2))
    assert lay_out("arena", 7, names(2)).obstacles != lay_out("arena", 8, names(2)).obstacles
    assert lay_out("maze", 7, names(2)).obstacles != lay_out("maze", 8, names(2)).obstacles


def test_neighbouring_obstacles_leave_a_way_between_them() -> None:
    narrowest = CELL - 2 * (LARGEST_RADIUS + LARGEST_SHIFT)
    assert narrowest > 3 * FOOTPRINT_RADIUS
    for seed in SEEDS:
        for one, other in combinations(lay_out("arena", seed, names(2)).obstacles, 2):
            radius = other.radius if isinstance(other, Cylinder) else math.hypot(other.half_x, other.half_y)
            assert distance(one, other.x, other.y) - radius >= narrowest - 1e-9


def test_obstacles_keep_away_from_start_poses_that_are_given() -> None:
    for seed in SEEDS:
        layout = lay_out("arena", seed, ["a"], [Pose(1.0, 1.0, 0.0)])
        assert room(layout, 1.0, 1.0) > 3 * FOOTPRINT_RADIUS
        assert layout.starts[0].pose == Pose(1.0, 1.0, 0.0)


@pytest.mark.parametrize("seed", range(20))
def test_every_cell_of_a_maze_can_be_reached(seed: int) -> None:
    layout = lay_out("maze", seed, ["a"])
    side = round(2 * layout.half / CELL)
    reached, edge = {(0, 0)}, [(0, 0)]
    while edge:
        column, row = edge.pop()
        for cell in ((column + 1, row), (column - 1, row), (column, row + 1), (column, row - 1)):
            if (
                cell not in reached
                and min(cell) >= 0
                and max(cell) < side
                and _open(layout, (column, row), cell)
            ):
                reached.add(cell)
                edge.append(cell)
    assert len(reached) == side * side


def test_a_maze_without_loops_has_one_way_between_any_two_cells() -> None:
    side = 6
    borders = 2 * side * (side - 1)
    chance = random.Random(3)  # noqa: S311 - no secrets in a maze
    assert len(closed_edges(side, chance)) == borders - (side * side - 1)


def _open(layout: Layout, one: tuple[int, int], other: tuple[int, int]) -> bool:
    x, y = ((a + b + 1) / 2 * CELL - layout.half for a, b in zip(one, other, strict=True))
    return room(layout, x, y) > 0.0


@pytest.mark.parametrize(
    ("world", "robots", "poses", "reason"),
    [
        ("moon", ["a"], [], "there are arena, maze, corridor, warehouse"),
        ("arena", ["a", "b"], [Pose(0.0, 0.0, 0.0)], "1 start poses for 2 robots"),
        ("arena", ["a"], [Pose(4.9, 0.0, 0.0)], "a cannot start at x 4.9, y 0"),
        ("arena", ["a"], [Pose(50.0, 0.0, 0.0)], "a cannot start"),
        ("arena", ["a"], [Pose(math.nan, 0.0, 0.0)], "a cannot start"),
        ("arena", ["a", "b"], [Pose(0.0, 0.0, 0.0), Pose(0.3, 0.0, 0.0)], "inside one another"),
    ],
)
def test_a_world_that_cannot_be_is_refused_with_the_reason(
    world: str, robots: list[str], poses: list[Pose], reason: str
) -> None:
    with pytest.raises(LayoutError, match=reason):
        lay_out(world, 1, robots, poses)


def test_distances_from_shapes() -> None:
    box = Box("box", 1.0, 0.0, 0.5, 0.25, math.pi / 2, 1.0)
    assert distance(box, 1.0, 1.0) == pytest.approx(0.5)
    assert distance(box, 2.0, 0.0) == pytest.approx(0.75)
    assert distance(box, 1.25 + 0.3, 0.5 + 0.4) == pytest.approx(0.5)
    assert distance(box, 1.0, 0.0) == pytest.approx(-0.25)
    assert distance(Cylinder("post", 0.0, 0.0, 0.2, 1.0), 0.3, 0.4) == pytest.approx(0.3)
