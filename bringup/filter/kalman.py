"""The linear algebra of one prediction and one correction.

Matrices are 15x15, so that the number of calls counts and not their size: rows are taken with `take`, products are
`dot`, and what is symmetric is not computed twice.
"""

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from bringup.filter.motion import advance
from bringup.filter.settings import NEVER_REJECT
from bringup.filter.state import Array, Indices, wrap, wrap_orientation

_FIRST_ANGLE, _LAST_ANGLE = 3, 5
_PAIR = 2
# Below this share of the product of variances, a determinant is mostly rounding.
_WELL_APART = 1e-6


def predict(state: Array, covariance: Array, noise: Array, dt: float) -> tuple[Array, Array]:
    """Move state and covariance on by `dt` seconds; `noise` is the process noise per second (15x15)."""
    moved, jacobian = advance(state, dt)
    spread = jacobian.dot(covariance).dot(jacobian.T)
    spread += noise * dt
    # Evens out what rounding has made of a symmetric matrix.
    spread += spread.T.copy()
    spread *= 0.5
    return moved, spread


def correct(
    state: Array,
    covariance: Array,
    indices: Indices,
    values: Sequence[float],
    noise: Array,
    threshold: float = NEVER_REJECT,
) -> tuple[Array, Array] | None:
    """Fuse direct measurements of some state variables.

    Args:
        state: 15 values.
        covariance: 15x15, symmetric.
        indices: which m state variables are measured.
        values: what was measured, m values.
        noise: m x m covariance of the measurement, symmetric and positive.
        threshold: Mahalanobis distance from which on the whole measurement is refused.

    Returns:
        The corrected state and covariance (Joseph form, symmetric), or None if the gate refused it.
    """
    innovation = _innovation(state, indices, values)
    rows = covariance.take(indices, 0)
    spread = rows.take(indices, 1)
    spread += noise
    inverse = _inverse(spread)
    if threshold < NEVER_REJECT and float(innovation.dot(inverse).dot(innovation)) >= threshold * threshold:
        return None
    gain = inverse.dot(rows)
    # Joseph's (I - KH) P (I - KH)' + K R K' multiplied out is P - B - B' with B = K (HP - S K' / 2), since H only
    # picks rows and columns; `gain` is K', `rows` is HP. Whatever rounding has made of K, this is symmetric.
    half = spread.dot(gain)
    half *= -0.5
    half += rows
    change = gain.T.dot(half)
    change += change.T.copy()
    corrected = state + innovation.dot(gain)
    wrap_orientation(corrected)
    return corrected, covariance - change


def _innovation(state: Array, indices: Indices, values: Sequence[float]) -> Array:
    differences = [value - here for value, here in zip(values, state.take(indices).tolist(), strict=True)]
    for place in _angles_among(indices.tobytes()):
        if not -math.pi < differences[place] <= math.pi:
            differences[place] = wrap(differences[place])
    return np.array(differences)


@lru_cache(maxsize=256)
def _angles_among(indices: bytes) -> tuple[int, ...]:
    """Tell which of some state variables, given as the bytes of their `Indices`, are angles."""
    every = np.frombuffer(indices, np.intp).tolist()
    return tuple(place for place, index in enumerate(every) if _FIRST_ANGLE <= index <= _LAST_ANGLE)


def _inverse(matrix: Array) -> Array:
    """Invert a small symmetric positive matrix; one and two rows without the detour over LAPACK."""
    if len(matrix) == 1:
        return 1.0 / matrix
    if len(matrix) == _PAIR:
        (a, b), (c, d) = matrix.tolist()
        determinant = a * d - b * c
        if determinant > _WELL_APART * abs(a * d):
            return np.array(((d / determinant, -b / determinant), (-c / determinant, a / determinant)))
    return np.asarray(np.linalg.inv(matrix), dtype=np.float64)
