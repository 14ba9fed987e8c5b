"""Two robots wander in the bringup's own MuJoCo worlds, with its lidar, wheels and noise, as fast as it goes."""

import math
from dataclasses import dataclass, field

import numpy as np
import pytest

from bringup.control.command import Pose
from bringup.control.controller import Odometry, Sight, State, ticked
from bringup.control.settings import Settings
from bringup.control.sight import obstacle_points
from bringup.world import odometry
from bringup.world.drive import Twist
from bringup.world.layout import WORLDS, lay_out
from bringup.world.lidar import ANGLE_INCREMENT, ANGLE_MIN, RANGE_MAX, RANGE_MIN, RAYS, Lidar, noisy
from bringup.world.model import TICKS_PER_SECOND, load, pose, wheel_angles
from bringup.world.odometry import WheelErrors
from bringup.world.simulation import Simulation

LIDAR_NOISE = 0.01
# Ticks between the loop's decision and the base obeying it.
LATENCY = 3


@dataclass
class Driver:
    """One robot's controller with the sensors it listens to, each in its own phase of the 10 Hz."""

    lidar: Lidar
    wheels: odometry.Odometry
    settings: Settings
    phase: int
    state: State = field(default_factory=State)
    sight: Sight | None = None
    heard: Odometry | None = None
    commands: list[Twist] = field(default_factory=lambda: [Twist(0.0, 0.0)] * (LATENCY + 1))
    way: float = 0.0
    cells: set[tuple[int, int]] = field(default_factory=set)
    rest: float = 0.0
    longest_rest: float = 0.0


def drivers(simulation: Simulation, seed: int, chance: np.random.Generator) -> list[Driver]:
    return [
        Driver(
            Lidar(simulation.model, robot),
            odometry.Odometry(WheelErrors(), 2 / TICKS_PER_SECOND, chance),
            Settings(mode="wander", seed=1000 * number + seed),
            phase=int(chance.integers(0, 10)),
        )
        for number, robot in enumerate(simulation.model.robots)
    ]


def listen(simulation: Simulation, number: int, driver: Driver, chance: np.random.Generator) -> None:
    now, data = simulation.time, simulation.data
    if simulation.ticks % 2 == 0:
        angles = wheel_angles(data, simulation.model.robots[number])
        estimate = driver.wheels.update(angles).pose
        driver.heard = Odometry(now, Pose(estimate.x, estimate.y, estimate.yaw))
    if simulation.ticks % 10 == 0:
        ranges = noisy(driver.lidar.measure(data), LIDAR_NOISE, chance)
        points = obstacle_points(ranges, (ANGLE_MIN, ANGLE_INCREMENT), (RANGE_MIN, RANGE_MAX), 0.0)
        assert points is not None
        driver.sight = Sight(now, points, driver.heard.pose if driver.heard else None)


def decide(simulation: Simulation, driver: Driver) -> Twist:
    if simulation.ticks % 10 == driver.phase:
        driver.state = ticked(driver.state, driver.settings, simulation.time, driver.sight, driver.heard)
    command = driver.state.command
    driver.commands = [*driver.commands[1:], Twist(command.linear, command.angular)]
    return driver.commands[0]


def follow(simulation: Simulation, number: int, driver: Driver, before: tuple[float, float]) -> None:
    here = pose(simulation.data, simulation.model.robots[number])
    step = math.hypot(here.x - before[0], here.y - before[1])
    driver.way += step
    driver.cells.add((math.floor(here.x), math.floor(here.y)))
    driver.rest = 0.0 if step * TICKS_PER_SECOND > 0.02 else driver.rest + 1 / TICKS_PER_SECOND
    driver.longest_rest = max(driver.rest, driver.longest_rest)


def wander(world: str, seed: int, seconds: float, world_seed: int = 1) -> tuple[Simulation, list[Driver]]:
    simulation = Simulation(load(lay_out(world, world_seed, ["robot1", "robot2"])))
    chance = np.random.default_rng(seed)
    crew = drivers(simulation, seed, chance)
    for _ in range(round(seconds * TICKS_PER_SECOND)):
        for number, driver in enumerate(crew):
            listen(simulation, number, driver, chance)
        poses = [pose(simulation.data, robot) for robot in simulation.model.robots]
        simulation.tick([decide(simulation, driver) for driver in crew])
        for number, (driver, before) in enumerate(zip(crew, poses, strict=True)):
            follow(simulation, number, driver, (before.x, before.y))
    return simulation, crew


def touches(simulation: Simulation) -> list[int]:
    return [count.episodes for count in simulation.contacts]


@pytest.mark.parametrize("world", ["arena", "maze"])
def test_wandering_robots_touch_nothing_in_a_minute(world: str) -> None:
    simulation, crew = wander(world, seed=0, seconds=60.0)
    assert touches(simulation) == [0, 0]
    for driver in crew:
        assert driver.way > 8.0
        assert len(driver.cells) > 8


def test_robots_that_see_nothing_do_touch(monkeypatch: pytest.MonkeyPatch) -> None:
    """The counts of the other tests are worth something."""
    monkeypatch.setattr(Lidar, "measure", lambda *_: np.full(RAYS, np.inf))
    simulation, _ = wander("arena", seed=0, seconds=60.0)
    assert sum(touches(simulation)) > 0


@pytest.mark.long
@pytest.mark.timeout(900)
@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("world", WORLDS)
def test_no_seed_leads_to_a_touch_in_five_minutes(world: str, seed: int) -> None:
    simulation, crew = wander(world, seed, seconds=300.0, world_seed=seed)
    assert touches(simulation) == [0, 0]
    for driver in crew:
        assert driver.way > 60.0
        assert len(driver.cells) > 25
        assert driver.longest_rest < 15.0
