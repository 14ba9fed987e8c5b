"""One robot in lockstep: its sensors, its filter and its controller, as on the ROS graph but without one.

What the sensors say goes to the filter in the order of the numbers in the simulation's messages, with the covariances
that stand in them, and is taken in at once, in the order of simulated time.
"""

from __future__ import annotations

import math
import zlib
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from bringup.control.command import Pose as ControlPose
from bringup.control.controller import Odometry as Location
from bringup.control.controller import Sight, State, ticked
from bringup.control.sight import clear_points, obstacle_points
from bringup.filter.localization import Estimate, Localization
from bringup.filter.parameters import read_settings
from bringup.filter.readings import Heard
from bringup.filter.state import YAW, X, Y
from bringup.filter.transforms import Sample
from bringup.world.body import MOUNTS
from bringup.world.drive import STILL, Twist
from bringup.world.geometry import Pose
from bringup.world.lidar import ANGLE_INCREMENT, ANGLE_MIN
from bringup.world.messages import DRIVEN, NANOSECONDS_PER_TICK, PLANAR, SIDEWAYS, quaternion
from bringup.world.sensing import Sensors, due

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bringup.evaluation.scenario import Scenario
    from bringup.world.odometry import Estimate as Reckoned
    from bringup.world.sensing import InertialReading, Readings
    from bringup.world.simulation import Simulation

# Decisions of a controller in a simulated second, and ticks until the base obeys one.
DECISIONS = 10.0
LATENCY = 2
# How many numbers nav_msgs/Odometry and sensor_msgs/Imu have, and where those that are told begin.
ODOMETRY_NUMBERS, TWIST, POSE_COVARIANCE, TWIST_COVARIANCE = 85, 43, slice(7, 43), slice(49, 85)
IMU_NUMBERS, RATES, FORCES = 37, slice(13, 16), slice(25, 28)
RATES_COVARIANCE, FORCES_COVARIANCE = slice(16, 25, 4), slice(28, 37, 4)


class Complaints:
    """What a filter has to say against its parameters: a run with parameters that it refuses is worth nothing."""

    def warning(self, message: str) -> None:
        """Refuse."""
        raise ValueError(message)

    error = warning


class Member:
    """One robot of a run."""

    def __init__(self, simulation: Simulation, number: int, scenario: Scenario) -> None:
        self.robot = simulation.model.robots[number]
        self.believed = Pose(0.0, 0.0, 0.0)
        self.estimate: Estimate | None = None
        self._simulation = simulation
        self._sensors = Sensors(simulation, number, scenario.world.each[number], scenario.world.seed)
        self.filter, self._updates = _filter(self.robot.name, scenario)
        node = f"/{self.robot.name}/velocity_controller"
        # As the controller's node does, so that no two robots make the same choices.
        seed = zlib.crc32(f"{scenario.control.seed}{node}".encode())
        self._control = replace(scenario.control, seed=seed)
        self._state = State()
        self._sight: Sight | None = None
        self._location: Location | None = None
        self._commands = [STILL] * LATENCY

    def tick(self) -> Readings:
        """Let sensors, filter and controller do what is due at this tick."""
        ticks = self._simulation.ticks
        now = ticks * NANOSECONDS_PER_TICK
        readings = self._sensors.read()
        if readings.inertial is not None:
            self.filter.hear("imu0", said_by_imu(self.robot.name, now, readings.inertial), now)
        if readings.odometry is not None:
            self.believed = readings.odometry.pose
            self.filter.hear("odom0", said_by_wheels(self.robot.name, now, readings.odometry), now)
        if due(ticks, self._updates):
            self._fuse(now)
        if readings.ranges is not None:
            self._look(readings.ranges)
        if due(ticks, DECISIONS):
            time = self._simulation.time
            self._state = ticked(self._state, self._control, time, self._sight, self._location)
        return readings

    def command(self) -> Twist:
        """What the base obeys at the tick to come."""
        decided = self._state.command
        self._commands.append(Twist(decided.linear, decided.angular))
        return self._commands.pop(0)

    def _fuse(self, now: int) -> None:
        self.filter.update(now)
        self.estimate = self.filter.estimate()
        if self.estimate is not None:
            x, y, yaw = self.estimate.state[[X, Y, YAW]].tolist()
            self._location = Location(self._simulation.time, ControlPose(x, y, yaw))

    def _look(self, ranges: NDArray[np.float64]) -> None:
        lidar = self._sensors.settings.lidar
        geometry = (ANGLE_MIN, ANGLE_INCREMENT), (lidar.range_min, lidar.range_max), self._control.lidar_x
        points = obstacle_points(ranges, *geometry)
        if points is not None:
            pose = self._location.pose if self._location else None
            clear = clear_points(ranges, *geometry)
            self._sight = Sight(self._simulation.time, points, pose, clear)


def said_by_wheels(robot: str, stamp: int, estimate: Reckoned) -> Heard:
    """What the message of the wheels' odometry says."""
    numbers = np.zeros(ODOMETRY_NUMBERS)
    numbers[:2] = estimate.pose.x, estimate.pose.y
    numbers[5:7] = math.sin(estimate.pose.yaw / 2), math.cos(estimate.pose.yaw / 2)
    numbers[POSE_COVARIANCE].reshape(6, 6)[PLANAR] = estimate.pose_covariance
    numbers[TWIST], numbers[TWIST + 5] = estimate.twist.linear, estimate.twist.angular
    covariance = numbers[TWIST_COVARIANCE].reshape(6, 6)
    covariance[DRIVEN] = estimate.twist_covariance
    covariance[1, 1] = SIDEWAYS
    return Heard(stamp, f"{robot}/odom", f"{robot}/base_footprint", tuple(numbers.tolist()))


def said_by_imu(robot: str, stamp: int, reading: InertialReading) -> Heard:
    """What the message of the IMU says; it measures no orientation."""
    numbers = np.zeros(IMU_NUMBERS)
    numbers[3], numbers[4] = 1.0, -1.0
    numbers[RATES], numbers[FORCES] = reading.values[:3], reading.values[3:]
    numbers[RATES_COVARIANCE], numbers[FORCES_COVARIANCE] = reading.variances
    return Heard(stamp, f"{robot}/imu_link", "", tuple(numbers.tolist()))


def _filter(robot: str, scenario: Scenario) -> tuple[Localization, float]:
    """A robot's filter, and how often in a second it works."""
    told = {
        "use_sim_time": True,
        "odom_frame": f"{robot}/odom",
        "world_frame": f"{robot}/odom",
        "base_link_frame": f"{robot}/base_footprint",
    }
    settings, _ = read_settings({**scenario.filter, **told}, Complaints())
    made = Localization(settings)
    for mount in MOUNTS:
        sample = Sample(0, (mount.x, mount.y, mount.z), quaternion(mount.roll, mount.pitch, mount.yaw))
        made.frames.add_static(f"{robot}/{mount.parent}", f"{robot}/{mount.child}", sample)
    return made, settings.timing.frequency
