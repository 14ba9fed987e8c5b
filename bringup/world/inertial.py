"""The inertial measurement unit: gyroscope and accelerometer with white noise and a constant bias."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

SMALLEST_VARIANCE = 1e-9


@dataclass(frozen=True, slots=True)
class InertialNoise:
    """Standard deviation per sample and bias on every axis, in rad/s and m/s^2."""

    gyro_noise: float = 0.005
    gyro_bias: float = 0.0002
    accelerometer_noise: float = 0.05
    accelerometer_bias: float = 0.02


class Inertial:
    """One robot's IMU."""

    def __init__(self, noise: InertialNoise, chance: np.random.Generator) -> None:
        self._bias = np.repeat([noise.gyro_bias, noise.accelerometer_bias], 3)
        self._deviation = np.repeat([noise.gyro_noise, noise.accelerometer_noise], 3)
        self._chance = chance

    def measure(self, true: NDArray[np.float64]) -> list[float]:
        """What it reports for true turning rates (three, rad/s) and accelerations (three, m/s^2)."""
        reported = true + self._bias + self._deviation * self._chance.standard_normal(6)
        values: list[float] = reported.tolist()
        return values


def variance(noise: float, bias: float) -> float:
    """The expected square of the error, which holds the bias as well; never 0, which would mean unknown."""
    return noise * noise + bias * bias + SMALLEST_VARIANCE
