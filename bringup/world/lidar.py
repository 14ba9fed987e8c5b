"""The laser scanner: one horizontal fan of beams from the robot's laser frame."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import mujoco
import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bringup.world.model import Model, Robot

RAYS = 360
ANGLE_MIN = -math.pi
ANGLE_INCREMENT = math.tau / RAYS
RANGE_MIN = 0.12
RANGE_MAX = 12.0
PERIOD = 0.1


class Lidar:
    """One robot's scanner. It sees walls, obstacles and other robots' hulls, and nothing of its own robot."""

    def __init__(self, model: Model, robot: Robot) -> None:
        self._physics = model.physics
        self._robot = robot
        angles = ANGLE_MIN + ANGLE_INCREMENT * np.arange(RAYS)
        self._beams = np.stack([np.cos(angles), np.sin(angles), np.zeros(RAYS)])
        self._geoms = np.zeros(RAYS, np.int32)
        self._distances = np.zeros(RAYS)

    def measure(self, data: Any) -> NDArray[np.float64]:  # noqa: ANN401 - MjData has no type
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
            RANGE_MAX,
        )
        hit = (self._distances >= 0.0) & (self._distances <= RANGE_MAX)
        return np.where(hit, self._distances, np.inf)


def noisy(
    distances: NDArray[np.float64], deviation: float, chance: np.random.Generator
) -> NDArray[np.float64]:
    """What the scanner reports for true distances: normal noise (metres) on what it hits, within its range."""
    # The same number of draws whatever is hit, so that runs with one seed stay comparable.
    reported = distances + deviation * chance.standard_normal(len(distances))
    return np.where(reported <= RANGE_MAX, np.maximum(reported, RANGE_MIN), np.inf)
