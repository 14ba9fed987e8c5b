"""The inertial measurement unit: gyroscope and accelerometer with white noise and a bias that strays."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from bringup.world.draws import Draws

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy as np

SMALLEST_VARIANCE = 1e-9
PERIOD = 0.01


@dataclass(frozen=True, slots=True)
class InertialNoise:
    """Standard deviation per sample and bias at the start on every axis, in rad/s and m/s^2.

    Walks: standard deviation of what a bias strays within one second, growing with the square root of the time.
    """

    gyro_noise: float = 0.005
    gyro_bias: float = 0.0002
    accelerometer_noise: float = 0.05
    accelerometer_bias: float = 0.02
    gyro_walk: float = 0.0
    accelerometer_walk: float = 0.0


class Inertial:
    """One robot's IMU; `noise` can be replaced at any time."""

    def __init__(self, noise: InertialNoise, chance: np.random.Generator) -> None:
        self._draws = Draws(chance)
        self._strayed = [0.0] * 6
        self._walked = [0.0, 0.0]
        self.noise = noise

    @property
    def noise(self) -> InertialNoise:
        """Its errors."""
        return self._noise

    @noise.setter
    def noise(self, noise: InertialNoise) -> None:
        self._noise = noise
        self._bias = [noise.gyro_bias] * 3 + [noise.accelerometer_bias] * 3
        self._deviation = [noise.gyro_noise] * 3 + [noise.accelerometer_noise] * 3
        self._walk = [noise.gyro_walk] * 3 + [noise.accelerometer_walk] * 3
        self._strays = any(self._walk)

    def measure(self, true: Iterable[float], dt: float = PERIOD) -> list[float]:
        """What it reports for true turning rates (three, rad/s) and accelerations (three, m/s^2), `dt` s later."""
        self._stray(dt)
        draws = self._draws.take(6)
        # Without checks of the lengths, which are all six: this is the busiest line of the sensors.
        parts = zip(true, self._bias, self._strayed, self._deviation, draws, strict=False)
        return [value + bias + strayed + deviation * draw for value, bias, strayed, deviation, draw in parts]

    def skip(self, dt: float = PERIOD) -> None:
        """Measure what nobody asks for: what comes after it is the same."""
        self._stray(dt)
        self._draws.skip(6)

    def _stray(self, dt: float) -> None:
        if not self._strays:
            return
        root = math.sqrt(dt)
        steps = zip(self._strayed, self._walk, self._draws.take(6), strict=True)
        self._strayed = [strayed + root * walk * draw for strayed, walk, draw in steps]
        self._walked[0] += dt * self._noise.gyro_walk**2
        self._walked[1] += dt * self._noise.accelerometer_walk**2

    def variances(self) -> tuple[float, float]:
        """The expected square of the error of a turning rate and of an acceleration, by now."""
        noise = self._noise
        return (
            variance(noise.gyro_noise, noise.gyro_bias) + self._walked[0],
            variance(noise.accelerometer_noise, noise.accelerometer_bias) + self._walked[1],
        )


def variance(noise: float, bias: float) -> float:
    """The expected square of the error, which holds the bias as well; never 0, which would mean unknown."""
    return noise * noise + bias * bias + SMALLEST_VARIANCE
