"""The inertial measurement unit: gyroscope and accelerometer with white noise and a constant bias."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

SMALLEST_VARIANCE = 1e-9


@dataclass(frozen=True, slots=True)
class InertialNoise:
    """Standard deviation per sample and bias on every axis, in rad/s and m/s^2."""

    gyro_noise: float = 0.005
    gyro_bias: float = 0.0005
    accelerometer_noise: float = 0.05
    accelerometer_bias: float = 0.02


def measured(
    true: NDArray[np.float64], noise: float, bias: float, chance: np.random.Generator
) -> tuple[float, float, float]:
    """What the sensor reports for a true vector."""
    x, y, z = (true + bias + noise * chance.standard_normal(3)).tolist()
    return x, y, z


def variance(noise: float, bias: float) -> float:
    """The expected square of the error, which holds the bias as well; never 0, which would mean unknown."""
    return noise * noise + bias * bias + SMALLEST_VARIANCE
