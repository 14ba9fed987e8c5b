import math
from dataclasses import replace

import numpy as np
import pytest

from bringup.world import lidar
from bringup.world.geometry import Pose
from bringup.world.layout import Start, lay_out
from bringup.world.lidar import Lidar, noisy
from bringup.world.model import load
from bringup.world.physics import mujoco
from bringup.world.shapes import Cylinder, Shape
from bringup.world.simulation import Simulation

AHEAD, LEFT, RIGHT = 180, 270, 90


def scan(*starts: Pose, obstacles: tuple[Shape, ...] = (), half: float = 5.0) -> "np.ndarray":
    """What the first robot sees in a world of four walls."""
    layout = lay_out("arena", 1, [f"robot{number}" for number in range(len(starts))])
    grown = [replace(wall, x=wall.x * half / 5.0, y=wall.y * half / 5.0) for wall in layout.walls]
    robots = tuple(Start(f"robot{number}", start) for number, start in enumerate(starts, start=1))
    made = replace(layout, half=half, walls=tuple(grown), obstacles=obstacles, starts=robots)
    simulation = Simulation(load(made))
    # Exactly level, which no robot is that rests on a caster.
    simulation.data.qpos[:] = simulation.model.physics.qpos0
    mujoco.mj_forward(simulation.model.physics, simulation.data)
    return Lidar(simulation.model, simulation.model.robots[0]).measure(simulation.data)


def test_walls_are_where_they_are() -> None:
    seen = scan(Pose(1.0, -2.0, 0.0))
    assert seen[AHEAD] == pytest.approx(4.0, abs=1e-6)
    assert seen[LEFT] == pytest.approx(7.0, abs=1e-6)
    assert seen[RIGHT] == pytest.approx(3.0, abs=1e-6)
    assert seen[0] == pytest.approx(6.0, abs=1e-6)


def test_the_beams_turn_with_the_robot() -> None:
    seen = scan(Pose(1.0, -2.0, math.pi / 2))
    assert seen[AHEAD] == pytest.approx(7.0, abs=1e-6)
    assert seen[LEFT] == pytest.approx(6.0, abs=1e-6)


def test_every_beam_meets_the_geometry_of_an_empty_room() -> None:
    seen = scan(Pose(0.5, 0.25, 0.0))
    for beam, distance in enumerate(seen):
        angle = lidar.ANGLE_MIN + beam * lidar.ANGLE_INCREMENT
        x, y = 0.5 + distance * math.cos(angle), 0.25 + distance * math.sin(angle)
        assert max(abs(x), abs(y)) == pytest.approx(5.0, abs=1e-6)


def test_an_obstacle_is_seen_and_the_own_robot_is_not() -> None:
    seen = scan(Pose(0.0, 0.0, 0.0), obstacles=(Cylinder("post", 2.0, 0.0, 0.3, 0.8),))
    assert seen[AHEAD] == pytest.approx(1.7, abs=1e-6)
    assert seen.min() == pytest.approx(1.7, abs=1e-3)


def test_another_robot_is_seen_as_its_hull() -> None:
    seen = scan(Pose(0.0, 0.0, 0.0), Pose(0.0, 1.5, 0.7))
    assert seen[LEFT] == pytest.approx(1.25, abs=1e-6)
    edge = math.degrees(math.asin(0.25 / 1.5))
    assert np.count_nonzero(seen[LEFT - 30 : LEFT + 30] < 2.0) == pytest.approx(2 * edge, abs=2)


def test_what_is_out_of_reach_is_infinitely_far() -> None:
    seen = scan(Pose(0.0, 0.0, 0.0), half=12.5)
    assert np.isinf(seen).all()


def test_noise_has_its_deviation_and_stays_within_the_range() -> None:
    chance = np.random.default_rng(1)
    reported = noisy(np.full(20_000, 3.0), 0.02, chance)
    assert reported.mean() == pytest.approx(3.0, abs=0.001)
    assert reported.std() == pytest.approx(0.02, rel=0.05)
    edges = noisy(np.array([0.13, 11.99, np.inf] * 1000), 0.5, chance)
    finite = edges[np.isfinite(edges)]
    assert finite.min() >= lidar.RANGE_MIN
    assert finite.max() <= lidar.RANGE_MAX
    assert np.isinf(edges[2::3]).all()


def test_without_noise_the_report_is_the_truth() -> None:
    true = np.array([1.0, 2.5, np.inf])
    assert noisy(true, 0.0, np.random.default_rng(1)).tolist() == true.tolist()
