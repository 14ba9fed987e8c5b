"""What one robot's sensors say, tick by tick, with all their errors; without ROS."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bringup.world.drive import Twist
from bringup.world.geometry import Pose, relative
from bringup.world.inertial import Inertial
from bringup.world.lidar import Lidar, reported
from bringup.world.model import TICKS_PER_SECOND, pose, twist, wheel_angles
from bringup.world.odometry import Estimate, Odometry

if TYPE_CHECKING:
    from bringup.world.settings import RobotSettings
    from bringup.world.simulation import Simulation


@dataclass(frozen=True, slots=True)
class Truth:
    """How the robot moves: pose as seen from where it started, velocity in its own frame, m/s to its left."""

    pose: Pose
    twist: Twist
    sideways: float


@dataclass(frozen=True, slots=True)
class InertialReading:
    """Three turning rates (rad/s), then three accelerations (m/s^2), and the variances of one of each."""

    values: list[float]
    variances: tuple[float, float]


@dataclass(frozen=True, slots=True)
class Readings:
    """What is new at a tick; None for a sensor that says nothing at it.

    `world` is the true pose in the world, `local` as seen from where the robot has started.
    """

    world: Pose
    local: Pose
    truth: Truth | None
    odometry: Estimate | None
    inertial: InertialReading | None
    ranges: NDArray[np.float64] | None


class Sensors:
    """The sensors of one robot of a simulation. `settings` can be replaced between two ticks.

    For one seed and one motion they say the same to the last bit; each sensor has a stream of chance of its own, so
    that none depends on how often another one speaks.
    """

    def __init__(self, simulation: Simulation, number: int, settings: RobotSettings, seed: int) -> None:
        self.robot = simulation.model.robots[number]
        self._simulation = simulation
        self._seeds = (seed, number)
        self._lidar = Lidar(simulation.model, self.robot)
        self.reset(settings)

    def reset(self, settings: RobotSettings) -> None:
        """Begin anew, as at the first tick."""
        wheels, inertial, self._lidar_chance = (
            np.random.default_rng(each) for each in np.random.SeedSequence(self._seeds).spawn(3)
        )
        self._settings = settings
        self._odometry = Odometry(settings.wheels, 1.0 / settings.odometry_rate, wheels)
        self._inertial = Inertial(settings.inertial, inertial)
        self._told = dict.fromkeys(("odometry", "inertial"), self._simulation.ticks)

    @property
    def settings(self) -> RobotSettings:
        """Errors and rates."""
        return self._settings

    @settings.setter
    def settings(self, settings: RobotSettings) -> None:
        self._settings = settings
        self._odometry.errors = settings.wheels
        self._inertial.noise = settings.inertial

    def read(self) -> Readings:
        """What the sensors say at the tick that the simulation has reached; to be called once at every tick."""
        simulation, settings = self._simulation, self._settings
        ticks, data = simulation.ticks, simulation.data
        here = pose(data, self.robot)
        local = relative(self.robot.start, here)
        return Readings(
            world=here,
            local=local,
            truth=Truth(local, *twist(data, self.robot, here.yaw))
            if due(ticks, settings.odometry_rate)
            else None,
            odometry=self._estimate(ticks) if due(ticks, settings.odometry_rate) else None,
            inertial=self._felt(ticks) if due(ticks, settings.imu_rate) else None,
            ranges=self._seen() if due(ticks, settings.scan_rate) else None,
        )

    def _estimate(self, ticks: int) -> Estimate:
        angles = wheel_angles(self._simulation.data, self.robot)
        return self._odometry.update(angles, self._since("odometry", ticks))

    def _felt(self, ticks: int) -> InertialReading:
        true = self._simulation.data.sensordata[self.robot.imu]
        values = self._inertial.measure(true, self._since("inertial", ticks))
        return InertialReading(values, self._inertial.variances())

    def _seen(self) -> NDArray[np.float64]:
        errors = self._settings.lidar
        return reported(
            self._lidar.measure(self._simulation.data, errors.range_max), errors, self._lidar_chance
        )

    def _since(self, sensor: str, ticks: int) -> float:
        """Simulated seconds since the sensor has last spoken."""
        passed = (ticks - self._told[sensor]) / TICKS_PER_SECOND
        self._told[sensor] = ticks
        return passed


def due(ticks: int, rate: float) -> bool:
    """Whether something that happens so often in a simulated second happens at this tick."""
    return int(ticks * rate / TICKS_PER_SECOND) > int((ticks - 1) * rate / TICKS_PER_SECOND)
