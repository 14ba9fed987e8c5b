"""How far measurements are from what the filter expects of them, in its own terms."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bringup.filter.state import OUT_OF_PLANE, YAW, wrap

if TYPE_CHECKING:
    from bringup.evaluation.track import Rows
    from bringup.filter.measurement import Measurement
    from bringup.filter.state import Array

NANOSECONDS = 1e9


class Innovations:
    """Collects the normalised innovation squared (NIS) of each measurement, by the part of the sensor it comes from.

    It counts the variables that are measured, not those which `two_d_mode` holds at zero.
    """

    def __init__(self) -> None:
        self._rows: dict[str, list[tuple[float, float, float]]] = {}

    def __call__(self, measurement: Measurement, state: Array, covariance: Array) -> None:
        """Take down one measurement; `state` and `covariance` are those predicted for it."""
        kept = [
            place for place, index in enumerate(measurement.indices.tolist()) if index not in OUT_OF_PLANE
        ]
        indices = measurement.indices[kept]
        innovation = np.array(measurement.values)[kept] - state[indices]
        innovation[indices == YAW] = [wrap(float(angle)) for angle in innovation[indices == YAW]]
        spread = covariance[np.ix_(indices, indices)] + measurement.noise[np.ix_(kept, kept)]
        square = float(innovation @ np.linalg.solve(spread, innovation))
        rows = self._rows.setdefault(measurement.part, [])
        rows.append((measurement.stamp / NANOSECONDS, square, float(len(kept))))

    def rows(self) -> dict[str, Rows]:
        """For each part, rows of time (s), NIS and how many variables are in it."""
        return {part: np.array(rows) for part, rows in self._rows.items()}
