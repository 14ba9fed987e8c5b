"""The filter's errors over time, between the bounds that it gives itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bringup.evaluation.drawing.style import BAND, INK, colour, figure
from bringup.evaluation.errors import against_truth, deviations

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.figure import Figure

    from bringup.evaluation.track import Track

AXES = ("x (m)", "y (m)", "yaw (rad)")
# How many standard deviations the bounds are from zero.
SIGMAS = 3
# Bounds are smooth: every fifth row is enough, and makes small files.
COARSE = 5


def draw(tracks: Sequence[Track]) -> Figure:
    """A column for each robot, a row for each of x, y and yaw: error, bounds, and the wheels' error where it fits."""
    drawn = figure(max(5.0, 4.5 * len(tracks)), 6.0)
    grid = drawn.subplots(len(AXES), len(tracks), sharex=True, squeeze=False)
    for column, track in enumerate(tracks):
        errors, wheels = against_truth(track.filtered, track.truth), against_truth(track.wheels, track.truth)
        bounds = SIGMAS * deviations(track)
        for row, name in enumerate(AXES):
            axes = grid[row, column]
            axes.fill_between(
                track.times[::COARSE],
                -bounds[::COARSE, row],
                bounds[::COARSE, row],
                color=BAND,
                label=f"±{SIGMAS} sigma of the filter",
            )
            axes.axhline(0.0, color=INK, linewidth=0.5)
            largest = 1.3 * max(float(bounds[:, row].max()), float(np.abs(errors[:, row]).max()))
            fitting = np.where(np.abs(wheels[:, row]) < 2 * largest, wheels[:, row], np.nan)
            axes.plot(track.times, fitting, color=INK, linestyle=":", linewidth=0.8, label="wheel odometry")
            axes.plot(track.times, errors[:, row], color=colour(column), label="filtered")
            axes.set(ylim=(-largest, largest), ylabel=f"error in {name}" if column == 0 else "")
        grid[0, column].set_title(track.robot)
        grid[-1, column].set_xlabel("time (s)")
    handles, labels = grid[0, 0].get_legend_handles_labels()
    drawn.legend(handles, labels, loc="outside lower center", ncols=3)
    return drawn
