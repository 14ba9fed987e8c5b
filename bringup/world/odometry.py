"""Wheel odometry: dead reckoning from wheel angles, with the errors of real wheels and an honest account of them.

Four errors go in: a wrong belief in each wheel's radius, the steps in which an encoder counts, slip (a share of the
travel that changes slowly, as tyres and floor do), and noise (a random walk with the travelled way). The covariances
say what these do to the numbers: the radius errors are carried through the whole path as one unknown each, slip and
noise as a random walk, an encoder's steps as an error of the velocity, since they never add up.

The sums are written out in plain numbers: arrays of three would cost six times as much.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from bringup.world.body import WHEEL_RADIUS, WHEEL_SEPARATION
from bringup.world.draws import Draws
from bringup.world.drive import Twist
from bringup.world.geometry import Pose, wrap

if TYPE_CHECKING:
    from numpy.typing import NDArray

# Seconds for which slip stays about the same.
SLIP_TIME = 1.0
# What encoders cannot resolve, as a standard deviation of a wheel's velocity in m/s.
RESOLUTION = 1e-3
SMALLEST_VARIANCE = 1e-9


@dataclass(frozen=True, slots=True)
class WheelErrors:
    """What is wrong with the wheels, as the odometry suffers from it.

    Scales: believed radius over true radius. Slip: standard deviation of the share of travel that is counted too much
    or too little. Noise: standard deviation in metres after one metre, growing with the square root of the way.
    Counts: steps of an encoder per turn of its wheel, 0 for none.
    """

    left_scale: float = 1.01
    right_scale: float = 1.0
    slip: float = 0.01
    noise: float = 0.002
    counts: int = 0


Spread: TypeAlias = tuple[float, float, float, float, float, float]


class Estimate(NamedTuple):
    """Where the odometry believes the robot is and how it moves.

    Spreads: the rows of the covariances over (x, y, yaw) and (vx, vyaw) from the diagonal on, as plain numbers.
    """

    pose: Pose
    twist: Twist
    pose_spread: Spread
    twist_spread: tuple[float, float, float]

    @property
    def pose_covariance(self) -> NDArray[np.float64]:
        """The covariance over (x, y, yaw)."""
        xx, xy, xt, yy, yt, tt = self.pose_spread
        return np.array(((xx, xy, xt), (xy, yy, yt), (xt, yt, tt)))

    @property
    def twist_covariance(self) -> NDArray[np.float64]:
        """The covariance over (vx, vyaw)."""
        ahead, mixed, turning = self.twist_spread
        return np.array(((ahead, mixed), (mixed, turning)))


class Odometry:
    """The dead reckoning of one robot, which starts at the origin of its own frame; `errors` can be replaced."""

    def __init__(self, errors: WheelErrors, dt: float, chance: np.random.Generator) -> None:
        self.errors = errors
        self._dt = dt
        self._draws = Draws(chance)
        self._angles = (0.0, 0.0)
        # Slip in units of its standard deviation.
        self._slip = self._draws.take(2)
        self._pose = Pose(0.0, 0.0, 0.0)
        # The covariance of all that is random in a pose, as its spread.
        self._walk: Spread = (SMALLEST_VARIANCE, 0.0, 0.0, SMALLEST_VARIANCE, 0.0, SMALLEST_VARIANCE)
        # How x, y and yaw depend on each wheel's radius.
        self._of_left = (0.0, 0.0, 0.0)
        self._of_right = (0.0, 0.0, 0.0)

    def update(self, angles: tuple[float, float], dt: float | None = None) -> Estimate:
        """The estimate after `dt` more seconds, from how far the wheels have turned since the start (radians)."""
        dt = dt or self._dt
        counted = _stepped(angles[0], self.errors.counts), _stepped(angles[1], self.errors.counts)
        left, right = self._counted(counted[0] - self._angles[0], counted[1] - self._angles[1], dt)
        self._angles = counted
        way, turn = (left + right) / 2, (right - left) / WHEEL_SEPARATION
        heading = self._pose.yaw + turn / 2
        # The chord of the arc; its direction is the heading half way.
        chord = way * (math.sin(turn / 2) / (turn / 2) if turn else 1.0)
        dx, dy = chord * math.cos(heading), chord * math.sin(heading)
        self._spread(left, right, heading, dx, dy, dt)
        self._pose = Pose(self._pose.x + dx, self._pose.y + dy, wrap(self._pose.yaw + turn))
        twist = Twist(way / dt, turn / dt)
        return Estimate(self._pose, twist, self._pose_spread(), self._twist_spread(left, right, dt))

    def _counted(self, left: float, right: float, dt: float) -> tuple[float, float]:
        """The travel of each wheel that is counted for so much turning."""
        errors, (keep, fresh) = self.errors, _forgetting(dt)
        draws = self._draws.take(4)
        self._slip = [keep * slip + fresh * draw for slip, draw in zip(self._slip, draws, strict=False)]
        return (
            WHEEL_RADIUS * left * (errors.left_scale + errors.slip * self._slip[0])
            + errors.noise * math.sqrt(WHEEL_RADIUS * abs(left)) * draws[2],
            WHEEL_RADIUS * right * (errors.right_scale + errors.slip * self._slip[1])
            + errors.noise * math.sqrt(WHEEL_RADIUS * abs(right)) * draws[3],
        )

    def _spread(self, left: float, right: float, heading: float, dx: float, dy: float, dt: float) -> None:
        """Carry the uncertainty along: the linearised motion model of a differential drive."""
        cos, sin, turn = math.cos(heading) / 2, math.sin(heading) / 2, 1 / WHEEL_SEPARATION
        x, y, yaw = self._of_left
        self._of_left = (x - dy * yaw + cos * left, y + dx * yaw + sin * left, yaw - turn * left)
        x, y, yaw = self._of_right
        self._of_right = (x - dy * yaw + cos * right, y + dx * yaw + sin * right, yaw + turn * right)
        one, other = self._walk_variance(abs(left), dt), self._walk_variance(abs(right), dt)
        both, apart = one + other, other - one
        xx, xy, xt, yy, yt, tt = self._walk
        self._walk = (
            xx - 2 * dy * xt + dy * dy * tt + cos * cos * both,
            xy + dx * xt - dy * yt - dx * dy * tt + cos * sin * both,
            xt - dy * tt + cos * turn * apart,
            yy + 2 * dx * yt + dx * dx * tt + sin * sin * both,
            yt + dx * tt + sin * turn * apart,
            tt + turn * turn * both,
        )

    def _walk_variance(self, way: float, dt: float) -> float:
        # Slip that forgets itself within SLIP_TIME is, in the long run, a random walk of this rate.
        slip = 2.0 * SLIP_TIME * self.errors.slip**2 * way / dt
        return (self.errors.noise**2 + slip) * way

    def _pose_spread(self) -> Spread:
        one, other = (self.errors.left_scale - 1.0) ** 2, (self.errors.right_scale - 1.0) ** 2
        (lx, ly, lt), (rx, ry, rt) = self._of_left, self._of_right
        xx, xy, xt, yy, yt, tt = self._walk
        return (
            xx + one * lx * lx + other * rx * rx,
            xy + one * lx * ly + other * rx * ry,
            xt + one * lx * lt + other * rx * rt,
            yy + one * ly * ly + other * ry * ry,
            yt + one * ly * lt + other * ry * rt,
            tt + one * lt * lt + other * rt * rt,
        )

    def _twist_spread(self, left: float, right: float, dt: float) -> tuple[float, float, float]:
        errors = self.errors
        # The difference of two counts that each are wrong by up to a step.
        step = math.tau * WHEEL_RADIUS / errors.counts if errors.counts else 0.0
        least = RESOLUTION**2 + step**2 / 6 / dt**2
        one = (
            ((errors.left_scale - 1.0) ** 2 + errors.slip**2) * left**2 + errors.noise**2 * abs(left)
        ) / dt**2
        other = (
            ((errors.right_scale - 1.0) ** 2 + errors.slip**2) * right**2 + errors.noise**2 * abs(right)
        ) / dt**2
        ahead, mixed = (one + other + 2 * least) / 4, (other - one) / 2 / WHEEL_SEPARATION
        return ahead, mixed, (one + other + 2 * least) / WHEEL_SEPARATION**2


@lru_cache(maxsize=16)
def _forgetting(dt: float) -> tuple[float, float]:
    """The share of slip that stays over so many seconds, and that of what comes anew."""
    keep = math.exp(-dt / SLIP_TIME)
    return keep, math.sqrt(1 - keep * keep)


def _stepped(angle: float, counts: int) -> float:
    """The angle as an encoder with so many counts per turn tells it."""
    return math.floor(angle * counts / math.tau) * math.tau / counts if counts else angle
