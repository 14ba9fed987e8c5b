"""Where the robots drove and where wheels and filters believed they were, on the map of the world."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.patches import Circle, Ellipse, Polygon

from bringup.evaluation.chi_square import quantile
from bringup.evaluation.drawing.style import BAND, OBSTACLE, WALL, colour, figure
from bringup.evaluation.errors import INSIDE
from bringup.world.shapes import Box, Cylinder, Shape

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from bringup.evaluation.track import Rows, Track

# Seconds between two ellipses.
BETWEEN_ELLIPSES = 10.0
# Metres of paper about everything.
MARGIN = 0.4


def draw(tracks: Sequence[Track], shapes: Sequence[Shape]) -> Figure:
    """One picture of all robots: the truth broad and pale, wheel odometry dotted, the filter thin with its ellipses."""
    drawn = figure(8.0, 6.6)
    axes = drawn.add_subplot()
    for shape in shapes:
        axes.add_patch(_patch(shape))
    for number, track in enumerate(tracks):
        _paths(axes, track, colour(number))
    _limits(axes, tracks, shapes)
    axes.set_aspect("equal")
    axes.set(xlabel="x (m)", ylabel="y (m)", title="Trajectories, with the filter's 95 % ellipses")
    drawn.legend(loc="outside right upper")
    return drawn


def ellipse(covariance: Rows) -> tuple[float, float, float]:
    """Full width, full height and turn (m, m, rad) of the 95 % ellipse of a 2 x 2 covariance."""
    values, vectors = np.linalg.eigh(covariance)
    width, height = 2.0 * np.sqrt(quantile(INSIDE, 2) * np.maximum(values[::-1], 0.0))
    return float(width), float(height), math.atan2(vectors[1, 1], vectors[0, 1])


def _paths(axes: Axes, track: Track, shade: str) -> None:
    true, wheels, filtered = (
        _placed(poses, track.start) for poses in (track.truth, track.wheels, track.filtered)
    )
    name = track.robot
    axes.plot(true[:, 0], true[:, 1], color=shade, alpha=0.3, linewidth=5.0, label=f"{name}, ground truth")
    axes.plot(wheels[:, 0], wheels[:, 1], color=shade, linestyle=":", label=f"{name}, wheel odometry")
    axes.plot(filtered[:, 0], filtered[:, 1], color=shade, linewidth=1.0, label=f"{name}, filtered")
    axes.add_patch(Circle(tuple(true[0]), 0.12, color=shade, zorder=4))
    turn = _turn(track.start[2])
    for row in _rows(track.times):
        width, height, angle = ellipse(turn @ track.covariance[row][:2, :2] @ turn.T)
        place = tuple(filtered[row])
        axes.add_patch(
            Ellipse(place, width, height, angle=math.degrees(angle), fill=False, color=shade, zorder=3)
        )


def _rows(times: Rows) -> list[int]:
    """The rows at which ellipses are drawn."""
    wanted = np.arange(times[0] + BETWEEN_ELLIPSES, times[-1] + 1e-6, BETWEEN_ELLIPSES)
    return [int(np.argmin(np.abs(times - moment))) for moment in wanted]


def _placed(poses: Rows, start: tuple[float, float, float]) -> Rows:
    """Positions in the world, from poses in the frame that stands where the robot started."""
    placed: Rows = poses[:, :2] @ _turn(start[2]).T + np.array(start[:2])
    return placed


def _turn(angle: float) -> Rows:
    return np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])


def _patch(shape: Shape) -> Circle | Polygon:
    shade = WALL if shape.name.startswith("wall") else OBSTACLE
    if isinstance(shape, Cylinder):
        return Circle((shape.x, shape.y), shape.radius, color=shade)
    return Polygon(corners(shape), color=shade)


def corners(box: Box) -> Rows:
    """The four corners of a box as seen from above."""
    offsets = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)]) * (box.half_x, box.half_y)
    placed: Rows = offsets @ _turn(box.yaw).T + (box.x, box.y)
    return placed


def _limits(axes: Axes, tracks: Sequence[Track], shapes: Sequence[Shape]) -> None:
    """The world and what was driven in it; wheel odometry that leads far out of it is cut off."""
    points = [_placed(track.truth, track.start) for track in tracks]
    points += [corners(shape) for shape in shapes if isinstance(shape, Box)]
    every = np.concatenate(points)
    low, high = every.min(axis=0) - MARGIN, every.max(axis=0) + MARGIN
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), facecolor="white" if shapes else BAND)
