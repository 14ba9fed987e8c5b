"""Quantiles of the chi-square distribution, which normalised squared errors follow where a covariance is right.

From the incomplete gamma function by its series (Abramowitz and Stegun 6.5.29). scipy would be a dependency of 40 MB
for this one number.
"""

from __future__ import annotations

import math
from functools import lru_cache

PRECISION = 1e-12
DOUBLINGS = 200


def probability(value: float, dof: float) -> float:
    """The probability that a chi-square variable with `dof` degrees of freedom is at most `value`."""
    if value <= 0.0:
        return 0.0
    shape, x = dof / 2.0, value / 2.0
    term = total = 1.0 / shape
    order = shape
    while term > PRECISION * total:
        order += 1.0
        term *= x / order
        total += term
    return min(1.0, total * math.exp(shape * math.log(x) - x - math.lgamma(shape)))


@lru_cache(maxsize=64)
def quantile(share: float, dof: float) -> float:
    """The value that a chi-square variable with `dof` degrees of freedom stays below with probability `share`.

    Raises ValueError for a share that is not between 0 and 1.
    """
    if not 0.0 < share < 1.0:
        raise ValueError(f"a share of {share} has no quantile")
    low, high = 0.0, dof
    while probability(high, dof) < share:
        low, high = high, 2.0 * high
    for _ in range(DOUBLINGS):
        middle = (low + high) / 2.0
        if high - low <= PRECISION * high:
            break
        low, high = (middle, high) if probability(middle, dof) < share else (low, middle)
    return (low + high) / 2.0


def mean_bounds(share: float, dof: int, count: int) -> tuple[float, float]:
    """Between which values the mean of `count` such variables lies with probability `share`, tails alike."""
    tail = (1.0 - share) / 2.0
    return quantile(tail, dof * count) / count, quantile(1.0 - tail, dof * count) / count
