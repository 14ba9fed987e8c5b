"""The linear algebra of one prediction and one correction."""

import numpy as np

from bringup.filter.motion import advance
from bringup.filter.state import Array, Indices, wrap, wrap_orientation

SMALLEST_VARIANCE = 1e-9

_FIRST_ANGLE, _LAST_ANGLE = 3, 5


def predict(state: Array, covariance: Array, noise: Array, dt: float) -> tuple[Array, Array]:
    """Move state and covariance on by `dt` seconds; `noise` is the process noise per second (15x15)."""
    moved, jacobian = advance(state, dt)
    return moved, jacobian @ covariance @ jacobian.T + noise * dt


def usable_noise(noise: Array) -> Array:
    """Copy a measurement covariance with its variances made positive and at least 1e-9."""
    fixed = noise.copy()
    size = len(fixed)
    diagonal = np.abs(fixed.diagonal())
    fixed.reshape(-1)[:: size + 1] = np.maximum(diagonal, SMALLEST_VARIANCE)
    return fixed


def correct(
    state: Array, covariance: Array, indices: Indices, values: Array, noise: Array, threshold: float
) -> tuple[Array, Array] | None:
    """Fuse direct measurements of some state variables.

    Args:
        state: 15 values.
        covariance: 15x15, symmetric.
        indices: which m state variables are measured.
        values: what was measured, m values.
        noise: m x m covariance of the measurement.
        threshold: Mahalanobis distance from which on the whole measurement is refused.

    Returns:
        The corrected state and covariance (Joseph form, kept symmetric), or None if the gate refused it.
    """
    innovation = values - state[indices]
    for place, index in enumerate(indices.tolist()):
        if _FIRST_ANGLE <= index <= _LAST_ANGLE:
            innovation[place] = wrap(float(innovation[place]))
    noise = usable_noise(noise)
    spread = covariance[:, indices]
    inverse = np.linalg.inv(spread[indices] + noise)
    if float(innovation @ inverse @ innovation) >= threshold * threshold:
        return None
    gain = spread @ inverse
    # Joseph's (I - KH) P (I - KH)' + K R K', multiplied out: H only picks rows and columns.
    half = covariance - gain @ spread.T
    updated = half - (half[:, indices] - gain @ noise) @ gain.T
    corrected = state + gain @ innovation
    wrap_orientation(corrected)
    return corrected, (updated + updated.T) * 0.5
