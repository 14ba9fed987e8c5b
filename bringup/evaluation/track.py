"""What a run leaves for one robot: where it was, where its wheels and its filter believed it was, row by row."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Rows = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """Rows of one robot at common times (seconds); poses are x, y, yaw in the frame in which the robot starts at 0.

    `covariance` is the filter's own over (x, y, yaw), one 3 x 3 matrix for each row. `nis` has rows of time,
    normalised innovation squared and number of variables, for each measurement that the filter has taken in;
    it is empty where nobody has told them.
    """

    robot: str
    start: tuple[float, float, float]
    times: Rows
    truth: Rows
    wheels: Rows
    filtered: Rows
    covariance: Rows
    nis: dict[str, Rows]
    contacts: int
