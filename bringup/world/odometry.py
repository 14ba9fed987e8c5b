"""Wheel odometry: dead reckoning from wheel angles, with the errors of real wheels and an honest account of them.

Three errors go in: a wrong belief in each wheel's radius, slip (a share of the travel that changes slowly, as tyres and
floor do), and noise (a random walk with the travelled way). The covariances say what these do to the numbers: the
radius errors are carried through the whole path as one unknown each, slip and noise as a random walk.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bringup.world.body import WHEEL_RADIUS, WHEEL_SEPARATION
from bringup.world.drive import Twist
from bringup.world.geometry import Pose, wrap

# Seconds for which slip stays about the same.
SLIP_TIME = 1.0
# What encoders cannot resolve, as a standard deviation of a wheel's velocity in m/s.
RESOLUTION = 1e-3
SMALLEST_VARIANCE = 1e-9
# (vx, vyaw) from the velocities of the left and the right wheel.
MOTION = np.array([[0.5, 0.5], [-1 / WHEEL_SEPARATION, 1 / WHEEL_SEPARATION]])


@dataclass(frozen=True, slots=True)
class WheelErrors:
    """What is wrong with the wheels, as the odometry suffers from it.

    Scales: believed radius over true radius. Slip: standard deviation of the share of travel that is counted too much
    or too little. Noise: standard deviation in metres after one metre, growing with the square root of the way.
    """

    left_scale: float = 1.01
    right_scale: float = 1.0
    slip: float = 0.01
    noise: float = 0.002


@dataclass(frozen=True, slots=True)
class Estimate:
    """Where the odometry believes the robot is and how it moves; covariances over (x, y, yaw) and (vx, vyaw)."""

    pose: Pose
    twist: Twist
    pose_covariance: NDArray[np.float64]
    twist_covariance: NDArray[np.float64]


class Odometry:
    """The dead reckoning of one robot, which starts at the origin of its own frame."""

    def __init__(self, errors: WheelErrors, dt: float, chance: np.random.Generator) -> None:
        self._errors = errors
        self._dt = dt
        self._chance = chance
        self._angles = (0.0, 0.0)
        self._slip = errors.slip * chance.standard_normal(2)
        self._pose = Pose(0.0, 0.0, 0.0)
        # How the pose depends on each wheel's radius, and the covariance of all that is random.
        self._sensitivity = np.zeros((3, 2))
        self._walk = SMALLEST_VARIANCE * np.eye(3)
        self._radius_variances = np.square([errors.left_scale - 1.0, errors.right_scale - 1.0])

    def update(self, angles: tuple[float, float]) -> Estimate:
        """The estimate after `dt` more seconds, from how far the wheels have turned since the start (radians)."""
        left, right = self._counted([now - then for now, then in zip(angles, self._angles, strict=True)])
        self._angles = angles
        way, turn = (left + right) / 2, (right - left) / WHEEL_SEPARATION
        heading = self._pose.yaw + turn / 2
        # The chord of the arc; its direction is the heading half way.
        chord = way * (math.sin(turn / 2) / (turn / 2) if turn else 1.0)
        dx, dy = chord * math.cos(heading), chord * math.sin(heading)
        self._spread(left, right, heading, dx, dy)
        self._pose = Pose(self._pose.x + dx, self._pose.y + dy, wrap(self._pose.yaw + turn))
        twist = Twist(way / self._dt, turn / self._dt)
        return Estimate(self._pose, twist, self._pose_covariance(), self._twist_covariance(left, right))

    def _counted(self, turned: list[float]) -> tuple[float, float]:
        keep = math.exp(-self._dt / SLIP_TIME)
        draws = self._chance.standard_normal((2, 2))
        self._slip = keep * self._slip + math.sqrt(1 - keep * keep) * self._errors.slip * draws[0]
        scales = self._errors.left_scale, self._errors.right_scale
        left, right = (
            WHEEL_RADIUS * angle * (scale + float(slip))
            + self._errors.noise * math.sqrt(WHEEL_RADIUS * abs(angle)) * float(draw)
            for angle, scale, slip, draw in zip(turned, scales, self._slip, draws[1], strict=True)
        )
        return left, right

    def _spread(self, left: float, right: float, heading: float, dx: float, dy: float) -> None:
        """Carry the uncertainty along: the linearised motion model of a differential drive."""
        motion = np.array([[1.0, 0.0, -dy], [0.0, 1.0, dx], [0.0, 0.0, 1.0]])
        cos, sin = math.cos(heading) / 2, math.sin(heading) / 2
        wheels = np.array([[cos, cos], [sin, sin], [-1 / WHEEL_SEPARATION, 1 / WHEEL_SEPARATION]])
        random = np.array([self._walk_variance(abs(left)), self._walk_variance(abs(right))])
        self._sensitivity = motion @ self._sensitivity + wheels * (left, right)
        self._walk = motion @ self._walk @ motion.T + (wheels * random) @ wheels.T

    def _walk_variance(self, way: float) -> float:
        # Slip that forgets itself within SLIP_TIME is, in the long run, a random walk of this rate.
        slip = 2.0 * SLIP_TIME * self._errors.slip**2 * way / self._dt
        return (self._errors.noise**2 + slip) * way

    def _pose_covariance(self) -> NDArray[np.float64]:
        covariance: NDArray[np.float64] = (self._sensitivity * self._radius_variances) @ self._sensitivity.T
        return covariance + self._walk

    def _twist_covariance(self, left: float, right: float) -> NDArray[np.float64]:
        way = np.abs([left, right])
        shares = self._radius_variances + self._errors.slip**2
        wheels = (shares * way**2 + self._errors.noise**2 * way) / self._dt**2 + RESOLUTION**2
        covariance: NDArray[np.float64] = (MOTION * wheels) @ MOTION.T
        return covariance
