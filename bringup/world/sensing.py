"""What one robot's sensors say, tick by tick, with all their errors; without ROS."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bringup.world.geometry import Pose, relative
from bringup.world.inertial import Inertial
from bringup.world.lidar import Lidar, reported, skip
from bringup.world.model import TICKS_PER_SECOND, Moment, Robot, moving, placed, wheel_angles
from bringup.world.odometry import Estimate, Odometry

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bringup.world.drive import Twist
    from bringup.world.settings import RobotSettings
    from bringup.world.simulation import Simulation


class Truth(NamedTuple):
    """How the robot moves: pose as seen from where it started, velocity in its own frame, m/s to its left."""

    pose: Pose
    twist: Twist
    sideways: float


class InertialReading(NamedTuple):
    """Three turning rates (rad/s), then three accelerations (m/s^2), and the variances of one of each."""

    values: list[float]
    variances: tuple[float, float]


class Asked(NamedTuple):
    """What of the readings somebody asks for. What is left out changes nothing in what is read later."""

    truth: bool = True
    inertial: bool = True
    ranges: bool = True


ALL = Asked()


class Readings(NamedTuple):
    """What is new at a tick; None for a sensor that says nothing at it, or that nobody asks."""

    robot: Robot
    moment: Moment
    truth: Truth | None
    odometry: Estimate | None
    inertial: InertialReading | None
    ranges: NDArray[np.float64] | None

    @property
    def world(self) -> Pose:
        """The true pose in the world."""
        return placed(self.moment, self.robot)

    @property
    def local(self) -> Pose:
        """The true pose as seen from where the robot has started."""
        return travelled(self.moment, self.robot)


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

    def looks(self, ticks: int, asked: Asked = ALL) -> bool:
        """Whether a sensor looks at the world itself at a tick, rather than at the numbers of its moment."""
        return asked.ranges and due(ticks, self._settings.scan_rate)

    def nearest(self) -> float:
        """Metres from the laser to the nearest thing that it can see now; inf if there is none."""
        return float(np.min(self._lidar.measure(self._simulation.data, self._settings.lidar.range_max)))

    def read(self) -> Readings:
        """What the sensors say at the tick that the simulation has reached; to be called once at every tick."""
        return self.read_at(self._simulation.ticks, self._simulation.moment())

    def read_at(self, ticks: int, now: Moment, asked: Asked = ALL) -> Readings:
        """What they say at a tick that may have passed, unless one of them looks at it."""
        settings = self._settings
        truth = odometry = None
        if due(ticks, settings.odometry_rate):
            truth = self._true(now) if asked.truth else None
            odometry = self._odometry.update(wheel_angles(now, self.robot), self._since("odometry", ticks))
        inertial = self._felt(now, ticks, asked) if due(ticks, settings.imu_rate) else None
        ranges = self._seen(asked) if due(ticks, settings.scan_rate) else None
        return Readings(self.robot, now, truth, odometry, inertial, ranges)

    def _true(self, now: Moment) -> Truth:
        here = placed(now, self.robot)
        return Truth(relative(self.robot.start, here), *moving(now, self.robot, here.yaw))

    def _felt(self, now: Moment, ticks: int, asked: Asked) -> InertialReading | None:
        passed = self._since("inertial", ticks)
        if not asked.inertial:
            self._inertial.skip(passed)
            return None
        values = self._inertial.measure(now.sensordata[self.robot.imu], passed)
        return InertialReading(values, self._inertial.variances())

    def _seen(self, asked: Asked) -> NDArray[np.float64] | None:
        errors = self._settings.lidar
        if not asked.ranges:
            skip(errors, self._lidar_chance)
            return None
        return reported(
            self._lidar.measure(self._simulation.data, errors.range_max), errors, self._lidar_chance
        )

    def _since(self, sensor: str, ticks: int) -> float:
        """Simulated seconds since the sensor has last spoken."""
        passed = (ticks - self._told[sensor]) / TICKS_PER_SECOND
        self._told[sensor] = ticks
        return passed


def travelled(moment: Moment, robot: Robot) -> Pose:
    """Where a robot is, as seen from where it has started."""
    return relative(robot.start, placed(moment, robot))


@lru_cache(maxsize=64)
def due(ticks: int, rate: float) -> bool:
    """Whether something that happens so often in a simulated second happens at this tick."""
    return int(ticks * rate / TICKS_PER_SECOND) > int((ticks - 1) * rate / TICKS_PER_SECOND)
