"""The linear algebra of one prediction and one correction.

Matrices are 15x15, so that the number of calls counts and not their size: rows are taken with `take`, products are
`dot`, and what is symmetric is not computed twice.
"""

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
    return moved, _symmetric(jacobian.dot(covariance).dot(jacobian.T) + noise * dt)


def correct(
    state: Array,
    covariance: Array,
    indices: Indices,
    values: Array,
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
        The corrected state and covariance (Joseph form, kept symmetric), or None if the gate refused it.
    """
    innovation = values - state.take(indices)
    for place, index in enumerate(indices.tolist()):
        if _FIRST_ANGLE <= index <= _LAST_ANGLE:
            innovation[place] = wrap(float(innovation[place]))
    rows = covariance.take(indices, 0)
    inverse = _inverse(rows.take(indices, 1) + noise)
    if threshold < NEVER_REJECT and float(innovation.dot(inverse).dot(innovation)) >= threshold * threshold:
        return None
    turned_gain = inverse.dot(rows)
    gain = turned_gain.T
    # Joseph's (I - KH) P (I - KH)' + K R K', multiplied out: H only picks rows and columns.
    half = covariance - gain.dot(rows)
    updated = half - (half.take(indices, 1) - gain.dot(noise)).dot(turned_gain)
    corrected = state + innovation.dot(turned_gain)
    wrap_orientation(corrected)
    return corrected, _symmetric(updated)


def _symmetric(matrix: Array) -> Array:
    """Even out, in place, what rounding has made of a symmetric matrix."""
    matrix += matrix.T.copy()
    matrix *= 0.5
    return matrix


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
