"""What the covariance of a measurement can be used for, and what is doubtful about it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from bringup.filter.state import NAMES, Array, Indices

SMALLEST_VARIANCE = 1e-9

_LARGEST = 1000.0
# Stands for "nothing is known", which some drivers say with an infinite variance.
_WEIGHTLESS = 1e15


@dataclass(frozen=True, slots=True, eq=False)
class Noise:
    """A covariance that can be used, and in words what had to be mended or can hardly be meant (empty: nothing)."""

    matrix: Array
    doubt: str = ""


def judged(covariance: Array, indices: Indices) -> Noise:
    """Make the finite covariance of a measurement of these state variables usable.

    Variances become positive and at least 1e-9 (upstream). Correlations that no variances could have are left out
    (upstream lets them ruin the estimate).
    """
    variances = covariance.diagonal().tolist()
    doubts = [
        f"{NAMES[index]} {variance:g}"
        for index, variance in zip(indices.tolist(), variances, strict=True)
        if not 0.0 < variance <= _LARGEST
    ]
    doubt = f"doubtful variances (zero, negative or above 1000): {', '.join(doubts)}" if doubts else ""
    usable = usable_noise(covariance)
    if is_positive(usable):
        return Noise(usable, doubt)
    impossible = "correlations that no measurement can have; they are left out"
    return Noise(np.diag(usable.diagonal()), f"{doubt}; {impossible}" if doubt else impossible)


def square(numbers: Sequence[float]) -> Array:
    """A covariance that is told row by row, as a matrix."""
    size = math.isqrt(len(numbers))
    return np.array(numbers).reshape(size, size)


def finite(covariance: Array) -> Array:
    """Leave a variable without weight whose variance is not finite; upstream lets it ruin the estimate."""
    if np.isfinite(covariance).all():
        return covariance
    unknown = ~np.isfinite(covariance.diagonal())
    known = np.where(np.isfinite(covariance), covariance, 0.0)
    known[unknown, :] = known[:, unknown] = 0.0
    known[unknown, unknown] = _WEIGHTLESS
    return known


def usable_noise(noise: Array) -> Array:
    """Copy a measurement covariance, made symmetric and with its variances positive and at least 1e-9."""
    fixed = (noise + noise.T) * 0.5
    np.fill_diagonal(fixed, np.maximum(np.abs(fixed.diagonal()), SMALLEST_VARIANCE))
    return fixed


def is_positive(matrix: Array) -> bool:
    """Whether a symmetric matrix with a positive diagonal is positive definite."""
    if np.count_nonzero(matrix) == len(matrix):
        return True
    try:
        np.linalg.cholesky(matrix)
    except np.linalg.LinAlgError:
        return False
    return True
