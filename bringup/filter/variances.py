"""Tells variances that can hardly be meant: too large to matter, zero or negative."""

from bringup.filter.measurement import Measurement
from bringup.filter.notices import Notices
from bringup.filter.state import NAMES

_LARGEST = 1000.0


def note_variances(measurement: Measurement, notices: Notices) -> None:
    """Note what is doubtful about the covariance of a measurement; it is fused all the same."""
    variances = measurement.noise.diagonal().tolist()
    doubtful = [
        f"{NAMES[index]} {variance:g}"
        for index, variance in zip(measurement.indices.tolist(), variances, strict=True)
        if variance <= 0.0 or variance > _LARGEST
    ]
    if doubtful:
        text = f"{measurement.part}: doubtful variances (zero, negative or above 1000): {', '.join(doubtful)}"
        notices.warn(f"{measurement.part}_covariance", text)
