"""The errors of a run against the truth, and how they compare with what the filter says of itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bringup.evaluation.chi_square import quantile

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bringup.evaluation.track import Rows, Track

PLANAR = 3
# The probability with which an error lies inside the ellipses that are spoken of here.
INSIDE = 0.95


def against_truth(poses: Rows, truth: Rows) -> Rows:
    """Errors in x and y (m) and in yaw (rad, within -pi and pi)."""
    errors = poses - truth
    errors[:, 2] = np.remainder(errors[:, 2] + np.pi, 2.0 * np.pi) - np.pi
    return errors


def position_rms(errors: Rows) -> float:
    """The root of the mean squared distance in metres."""
    return float(np.sqrt(np.mean(np.sum(errors[:, :2] ** 2, axis=1))))


def nees(track: Track) -> Rows:
    """The normalised estimation error squared over (x, y, yaw), for each row; chi-square with 3 if all is right."""
    errors = against_truth(track.filtered, track.truth)
    solved = np.linalg.solve(track.covariance, errors[:, :, np.newaxis])[:, :, 0]
    squares: Rows = np.einsum("ij,ij->i", errors, solved)
    return squares


def inside(track: Track) -> NDArray[np.bool_]:
    """Whether the error in (x, y, yaw) lies inside the filter's 95 % ellipse, for each row."""
    told: NDArray[np.bool_] = nees(track) <= quantile(INSIDE, PLANAR)
    return told


def row_at(track: Track, time: float) -> int:
    """The row nearest to a time in seconds."""
    return int(np.argmin(np.abs(track.times - time)))


def deviations(track: Track) -> Rows:
    """The filter's own standard deviations of x, y and yaw, for each row."""
    roots: Rows = np.sqrt(np.einsum("ijj->ij", track.covariance))
    return roots
