"""Whether errors and innovations are as large as the filter says: NEES and NIS with their chi-square bounds."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bringup.evaluation.chi_square import mean_bounds, quantile
from bringup.evaluation.drawing.style import BAND, INK, colour, figure
from bringup.evaluation.errors import INSIDE, PLANAR, nees

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from bringup.evaluation.track import Rows, Track

# Innovations are averaged over so many seconds: each single one says little.
WINDOW = 1.0


def draw(tracks: Sequence[Track]) -> Figure:
    """A column for each robot: NEES above, below it the NIS of each part of a sensor whose innovations are known."""
    parts = sorted({part for track in tracks for part in track.nis})
    drawn = figure(max(5.0, 4.5 * len(tracks)), 2.4 * (1 + len(parts)))
    grid = drawn.subplots(1 + len(parts), len(tracks), sharex=True, squeeze=False)
    for column, track in enumerate(tracks):
        _nees(grid[0, column], track, colour(column))
        for row, part in enumerate(parts, start=1):
            if part in track.nis:
                _nis(grid[row, column], part, track.nis[part], colour(column))
        grid[0, column].set_title(f"{track.robot}: NEES of (x, y, yaw)")
        grid[-1, column].set_xlabel("time (s)")
    return drawn


def averaged(rows: Rows, window: float = WINDOW) -> tuple[Rows, Rows, Rows]:
    """Times, means of the normalised squares and how many are in each, over windows of some seconds."""
    number = np.floor((rows[:, 0] - rows[0, 0]) / window).astype(int)
    counts = np.bincount(number)
    filled = counts > 0
    sums = np.bincount(number, weights=rows[:, 1])
    times = rows[0, 0] + (np.arange(len(counts)) + 0.5) * window
    return times[filled], sums[filled] / counts[filled], counts[filled].astype(float)


def _nees(axes: Axes, track: Track, shade: str) -> None:
    low, high = quantile((1 - INSIDE) / 2, PLANAR), quantile((1 + INSIDE) / 2, PLANAR)
    squares = nees(track)
    axes.axhspan(low, high, color=BAND, label="95 % of chi-square")
    axes.plot(track.times, squares, color=shade)
    axes.set(ylim=(0.0, max(1.3 * high, 1.05 * float(squares.max()))), ylabel="NEES")


def _nis(axes: Axes, part: str, rows: Rows, shade: str) -> None:
    times, means, counts = averaged(rows)
    size = round(float(rows[:, 2].mean()))
    low, high = mean_bounds(INSIDE, size, round(float(np.median(counts))))
    axes.axhspan(low, high, color=BAND)
    axes.axhline(size, color=INK, linewidth=0.5)
    axes.plot(times, means, color=shade)
    axes.set(ylim=(0.0, max(1.3 * high, 1.05 * float(means.max()))), ylabel="mean NIS")
    axes.set_title(
        f"NIS of {part} ({size} {'variable' if size == 1 else 'variables'}), means of {WINDOW:g} s"
    )
