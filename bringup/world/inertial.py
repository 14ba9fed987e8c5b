"""The inertial measurement unit: gyroscope and accelerometer with white noise and a bias that strays."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

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
        self._chance = chance
        self._strayed = np.zeros(6)
        self._walked = [0.0, 0.0]
        self.noise = noise

    @property
    def noise(self) -> InertialNoise:
        """Its errors."""
        return self._noise

    @noise.setter
    def noise(self, noise: InertialNoise) -> None:
        self._noise = noise
        self._bias = np.repeat([noise.gyro_bias, noise.accelerometer_bias], 3)
        self._deviation = np.repeat([noise.gyro_noise, noise.accelerometer_noise], 3)
        self._walk = np.repeat([noise.gyro_walk, noise.accelerometer_walk], 3)
        self._strays = bool(self._walk.any())

    def measure(self, true: NDArray[np.float64], dt: float = PERIOD) -> list[float]:
        """What it reports for true turning rates (three, rad/s) and accelerations (three, m/s^2), `dt` s later."""
        if self._strays:
            self._strayed += math.sqrt(dt) * self._walk * self._chance.standard_normal(6)
            self._walked[0] += dt * self._noise.gyro_walk**2
            self._walked[1] += dt * self._noise.accelerometer_walk**2
        reported = true + self._bias + self._strayed + self._deviation * self._chance.standard_normal(6)
        values: list[float] = reported.tolist()
        return values

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
