"""One robot in lockstep: its sensors, its filter and its controller, as on the ROS graph but without one.

The messages are those that the simulation's node publishes, so that filters see the same covariances; they are filled
and taken in at once, in the order of simulated time.
"""

from __future__ import annotations

import zlib
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from bringup.control.command import Pose as ControlPose
from bringup.control.controller import Odometry as Location
from bringup.control.controller import Sight, State, ticked
from bringup.control.sight import obstacle_points
from bringup.filter.localization import Estimate, Localization
from bringup.filter.parameters import read_settings
from bringup.filter.state import YAW, X, Y
from bringup.filter.transforms import Sample
from bringup.world import lidar, messages
from bringup.world.body import MOUNTS
from bringup.world.drive import STILL, Twist
from bringup.world.geometry import Pose
from bringup.world.inertial import Inertial
from bringup.world.model import TICKS_PER_SECOND, wheel_angles
from bringup.world.odometry import Odometry

if TYPE_CHECKING:
    from bringup.evaluation.scenario import Scenario
    from bringup.world.simulation import Simulation

ODOMETRY_TICKS = TICKS_PER_SECOND // 50
SCAN_TICKS = TICKS_PER_SECOND // 10
# Ticks between a controller's decision and the base obeying it.
LATENCY = 2
NO_TURN = (0.0, 0.0, 0.0, 1.0)


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
        self._simulation = simulation
        self._settings = scenario.world
        # The same streams of chance as those of the simulation's node.
        seeds = np.random.SeedSequence([scenario.world.seed, number]).spawn(3)
        wheels, inertial, self._lidar_chance = map(np.random.default_rng, seeds)
        self._odometry = Odometry(scenario.world.wheels, ODOMETRY_TICKS / TICKS_PER_SECOND, wheels)
        self._inertial = Inertial(scenario.world.inertial, inertial)
        self._lidar = lidar.Lidar(simulation.model, self.robot)
        self._imu_message = messages.new_imu(self.robot.name, scenario.world.inertial)
        self._odometry_message = messages.new_wheel_odometry(self.robot.name)
        self.filter = _filter(self.robot.name, scenario)
        node = f"/{self.robot.name}/velocity_controller"
        seed = zlib.crc32(f"{scenario.control.seed}{node}".encode())
        self._control = replace(scenario.control, seed=seed)
        self._state = State()
        self._sight: Sight | None = None
        self._location: Location | None = None
        self._commands = [STILL] * LATENCY

    def sense(self) -> None:
        """Let the filter have what the IMU and the wheels say at this tick."""
        ticks, data = self._simulation.ticks, self._simulation.data
        now = ticks * messages.NANOSECONDS_PER_TICK
        messages.stamp(self._imu_message.header.stamp, ticks)
        messages.fill_imu(self._imu_message, self._inertial.measure(data.sensordata[self.robot.imu]))
        self.filter.receive("imu0", self._imu_message, now)
        if ticks % ODOMETRY_TICKS:
            return
        estimate = self._odometry.update(wheel_angles(data, self.robot))
        message = self._odometry_message
        messages.stamp(message.header.stamp, ticks)
        messages.fill_motion(message, estimate.pose, estimate.twist)
        messages.fill_covariances(message, estimate.pose_covariance, estimate.twist_covariance)
        self.filter.receive("odom0", message, now)
        self.believed = estimate.pose

    def fuse(self) -> Estimate | None:
        """The filter's estimate after all that has come."""
        self.filter.update(self._simulation.ticks * messages.NANOSECONDS_PER_TICK)
        estimate = self.filter.estimate()
        if estimate is not None:
            x, y, yaw = estimate.state[[X, Y, YAW]].tolist()
            self._location = Location(self._simulation.time, ControlPose(x, y, yaw))
        return estimate

    def look(self) -> None:
        """Let the controller have a scan."""
        true = self._lidar.measure(self._simulation.data)
        ranges = lidar.noisy(true, self._settings.lidar_noise, self._lidar_chance)
        angles = lidar.ANGLE_MIN, lidar.ANGLE_INCREMENT
        points = obstacle_points(ranges, angles, (lidar.RANGE_MIN, lidar.RANGE_MAX), self._control.lidar_x)
        if points is not None:
            seen_from = self._location.pose if self._location else None
            self._sight = Sight(self._simulation.time, points, seen_from)

    def decide(self) -> None:
        """Let the controller make its next decision."""
        self._state = ticked(self._state, self._control, self._simulation.time, self._sight, self._location)

    def command(self) -> Twist:
        """What the base obeys at the tick to come."""
        decided = self._state.command
        self._commands.append(Twist(decided.linear, decided.angular))
        return self._commands.pop(0)


def _filter(robot: str, scenario: Scenario) -> Localization:
    frames = {
        "odom_frame": f"{robot}/odom",
        "world_frame": f"{robot}/odom",
        "base_link_frame": f"{robot}/base_footprint",
    }
    settings, _ = read_settings({**scenario.filter, **frames}, Complaints())
    made = Localization(settings)
    for mount in MOUNTS:
        sample = Sample(0, (mount.x, mount.y, mount.z), NO_TURN)
        made.frames.add_static(f"{robot}/{mount.parent}", f"{robot}/{mount.child}", sample)
    return made
