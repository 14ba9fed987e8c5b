"""The controller in a small kinematic world: rays against segments and discs, two robots that both drive."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from bringup.control.command import STANDSTILL, Command, Pose
from bringup.control.controller import Odometry, Sight, State, ticked
from bringup.control.settings import Settings
from bringup.control.sight import obstacle_points

Array = NDArray[np.float64]

STEP = 0.02
RAYS = 360
RADIUS = 0.25
BODY = 0.25  # what a lidar sees of the other robot
ANGLES = -math.pi + math.tau / RAYS * np.arange(RAYS)


def box(x: float, y: float, width: float, height: float) -> list[tuple[float, float, float, float]]:
    """The four sides of a rectangle about (x, y)."""
    left, right, low, high = x - width / 2, x + width / 2, y - height / 2, y + height / 2
    return [
        (left, low, right, low),
        (right, low, right, high),
        (right, high, left, high),
        (left, high, left, low),
    ]


def arena() -> Array:
    """10 x 10 m with boxes of several sizes."""
    sides = box(0, 0, 10, 10)
    for x, y, width, height in [
        (-2, 1, 0.6, 0.6), (1.5, 2.5, 1.0, 0.4), (2.5, -1.5, 0.5, 1.4), (-2.5, -2.5, 0.3, 0.3),
        (0, -3, 1.2, 0.3), (3.2, 1.2, 0.2, 0.2), (-3.4, 3.2, 0.8, 0.5), (0.2, 0.4, 0.4, 0.4),
    ]:  # fmt: skip
        sides += box(x, y, width, height)
    return np.array(sides)


def maze() -> Array:
    """10 x 10 m with walls 0.1 m thick, passages of about 1.2 m and a dead end."""
    sides = box(0, 0, 10, 10)
    for x, y, width, height in [
        (-3.6, -1.3, 0.1, 7.4), (-2.3, 1.3, 0.1, 7.4), (-1.0, -1.3, 0.1, 7.4), (1.6, 3.7, 5.2, 0.1),
        (2.3, 2.4, 5.4, 0.1), (1.6, 1.1, 5.2, 0.1), (0.3, -2.0, 0.1, 3.4), (2.9, -0.3, 5.2, 0.1),
        (1.6, -2.3, 0.1, 3.0), (3.5, -3.0, 0.1, 2.0),
    ]:  # fmt: skip
        sides += box(x, y, width, height)
    return np.array(sides)


@dataclass
class Robot:
    """A unicycle whose wheels follow a command with a lag, and what its controller knows."""

    x: float
    y: float
    yaw: float
    settings: Settings
    velocity: Command = STANDSTILL
    state: State = field(default_factory=State)
    sight: Sight | None = None
    way: float = 0.0
    cells: set[tuple[int, int]] = field(default_factory=set)
    rest: float = 0.0
    longest_rest: float = 0.0

    def drive(self) -> None:
        share = STEP / 0.06
        linear = self.velocity.linear + share * (self.state.command.linear - self.velocity.linear)
        angular = self.velocity.angular + share * (self.state.command.angular - self.velocity.angular)
        self.velocity = Command(linear, angular)
        self.x += STEP * linear * math.cos(self.yaw)
        self.y += STEP * linear * math.sin(self.yaw)
        self.yaw += STEP * angular
        self.way += STEP * abs(linear)
        self.cells.add((math.floor(self.x), math.floor(self.y)))
        self.rest = 0.0 if abs(linear) > 0.02 else self.rest + STEP
        self.longest_rest = max(self.rest, self.longest_rest)

    def pose(self) -> Pose:
        return Pose(self.x, self.y, self.yaw)


def ranges(robot: Robot, sides: Array, other: tuple[float, float] | None, noise: Array) -> Array:
    """Distances along every ray to the nearest side or to the other robot's body; inf beyond 12 m."""
    origin = np.array([robot.x, robot.y])
    rays = np.column_stack((np.cos(ANGLES + robot.yaw), np.sin(ANGLES + robot.yaw)))
    start, along = sides[:, :2] - origin, sides[:, 2:] - sides[:, :2]
    cross = rays[:, :1] * along[:, 1] - rays[:, 1:] * along[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        reach = (start[:, 0] * along[:, 1] - start[:, 1] * along[:, 0]) / cross
        place = (start[:, 0] * rays[:, 1:] - start[:, 1] * rays[:, :1]) / cross
    hit = (reach > 0) & (place >= 0) & (place <= 1)
    seen = np.where(hit, reach, np.inf).min(axis=1)
    if other is not None:
        offset = np.array(other) - origin
        middle = rays @ offset
        depth = BODY**2 - offset @ offset + middle**2
        body = np.where((depth > 0) & (middle > 0), middle - np.sqrt(np.maximum(depth, 0)), np.inf)
        seen = np.minimum(seen, body)
    seen = seen + noise
    return np.where(seen > 12.0, np.inf, seen)


def gap(robot: Robot, sides: Array) -> float:
    """Distance between the robot's circle and the nearest side."""
    start, along = sides[:, :2], sides[:, 2:] - sides[:, :2]
    offset = np.array([robot.x, robot.y]) - start
    share = np.clip(np.sum(offset * along, axis=1) / np.sum(along * along, axis=1), 0, 1)
    return float(np.hypot(*(offset - share[:, np.newaxis] * along).T).min()) - RADIUS


def drive(sides: Array, robots: list[Robot], seconds: float, seed: int) -> float:
    """Let all robots drive; the least distance that was ever left between two bodies."""
    chance = np.random.default_rng(seed)
    least = math.inf
    for step in range(round(seconds / STEP)):
        now = step * STEP
        for index, robot in enumerate(robots):
            others = [(each.x, each.y) for each in robots if each is not robot]
            if (step + 2 * index) % 5 == 0:
                seen = ranges(robot, sides, others[0] if others else None, chance.normal(0, 0.01, RAYS))
                points = obstacle_points(seen, (-math.pi, math.tau / RAYS), (0.12, 12.0), 0.0)
                assert points is not None
                robot.sight = Sight(now, points, robot.pose())
            if (step + 3 * index + 4) % 5 == 0:
                odometry = Odometry(now, robot.pose())
                robot.state = ticked(robot.state, robot.settings, now, robot.sight, odometry)
        for robot in robots:
            robot.drive()
            least = min(least, gap(robot, sides))
        for one, two in pairwise(robots):
            least = min(least, math.hypot(one.x - two.x, one.y - two.y) - 2 * RADIUS)
    return least


WORLDS: dict[str, tuple[Callable[[], Array], tuple[float, float, float], tuple[float, float, float]]] = {
    "arena": (arena, (-3.5, -0.5, 0.0), (3.8, -0.5, 3.0)),
    "maze": (maze, (-4.3, -4.0, 1.57), (4.3, 4.3, 3.14)),
}


def wander(world: str, seed: int, seconds: float) -> tuple[float, list[Robot]]:
    sides, *starts = WORLDS[world]
    robots = [
        Robot(*start, Settings(mode="wander", seed=10 * seed + index)) for index, start in enumerate(starts)
    ]
    return drive(sides(), robots, seconds, seed), robots


@pytest.mark.parametrize("world", WORLDS)
def test_two_wandering_robots_touch_nothing_and_see_the_world(world: str) -> None:
    least, robots = wander(world, seed=1, seconds=60.0)
    assert least > 0.0
    for robot in robots:
        assert robot.way > 8.0
        assert robot.longest_rest < 10.0


@pytest.mark.long
@pytest.mark.timeout(900)
@pytest.mark.parametrize("world", WORLDS)
@pytest.mark.parametrize("seed", range(10))
def test_no_seed_leads_to_a_touch_in_five_minutes(world: str, seed: int) -> None:
    least, robots = wander(world, seed, seconds=300.0)
    assert least > 0.0
    for robot in robots:
        assert robot.way > 40.0
        assert len(robot.cells) > 20
        assert robot.longest_rest < 15.0
