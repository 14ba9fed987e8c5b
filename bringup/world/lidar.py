"""The laser scanner: one horizontal fan of beams from the robot's laser frame."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from bringup.world.physics import mujoco

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bringup.world.model import Model, Robot

RAYS = 360
ANGLE_MIN = -math.pi
ANGLE_INCREMENT = math.tau / RAYS
RANGE_MIN = 0.12
RANGE_MAX = 12.0
PERIOD = 0.1


@dataclass(frozen=True, slots=True)
class LidarErrors:
    """Standard deviation of each range (m), the share of beams that measure nothing, nearest and farthest range."""

    noise: float = 0.01
    dropout: float = 0.0
    range_min: float = RANGE_MIN
    range_max: float = RANGE_MAX


class Lidar:
    """One robot's scanner. It sees walls, obstacles and other robots' hulls, and nothing of its own robot."""

    def __init__(self, model: Model, robot: Robot) -> None:
        self._physics = model.physics
        self._robot = robot
        angles = ANGLE_MIN + ANGLE_INCREMENT * np.arange(RAYS)
        self._beams = np.stack([np.cos(angles), np.sin(angles), np.zeros(RAYS)])
        self._geoms = np.zeros(RAYS, np.int32)
        self._distances = np.zeros(RAYS)

    def measure(self, data: Any, reach: float = RANGE_MAX) -> NDArray[np.float64]:  # noqa: ANN401 - MjData has no type
        """True distances in metres along the beams, from -pi on; inf where nothing is within reach (REP 117).

        The own wheels are not the body that is left out of sight, but lie below the beams.
        """
        turn = data.site_xmat[self._robot.laser].reshape(3, 3)
        mujoco.mj_multiRay(
            self._physics,
            data,
            data.site_xpos[self._robot.laser],
            (turn @ self._beams).T.ravel(),
            None,
            1,
            self._robot.body,
            self._geoms,
            self._distances,
            None,
            RAYS,
            reach,
        )
        hit = (self._distances >= 0.0) & (self._distances <= reach)
        return np.where(hit, self._distances, np.inf)


def reported(
    distances: NDArray[np.float64], errors: LidarErrors, chance: np.random.Generator
) -> NDArray[np.float64]:
    """What the scanner reports for true distances; a beam that drops out is NaN, no measurement (REP 117)."""
    ranges = noisy(distances, errors.noise, chance, (errors.range_min, errors.range_max))
    if errors.dropout:
        ranges[chance.random(len(ranges)) < errors.dropout] = np.nan
    return ranges


def skip(errors: LidarErrors, chance: np.random.Generator) -> None:
    """Draw what `reported` draws for a scan that nobody asks for: those after it are the same."""
    chance.standard_normal(RAYS)
    if errors.dropout:
        chance.random(RAYS)


def noisy(
    distances: NDArray[np.float64],
    deviation: float,
    chance: np.random.Generator,
    limits: tuple[float, float] = (RANGE_MIN, RANGE_MAX),
) -> NDArray[np.float64]:
    """True distances with normal noise (metres) on what is hit, within the scanner's limits."""
    # The same number of draws whatever is hit, so that runs with one seed stay comparable.
    measured = distances + deviation * chance.standard_normal(len(distances))
    return np.where(measured <= limits[1], np.maximum(measured, limits[0]), np.inf)
