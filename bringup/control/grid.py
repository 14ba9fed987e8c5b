"""What the lidar has shown of the surroundings: a grid of cells in the odometry frame, each with its evidence.

A hit speaks for an obstacle, a beam that goes through a cell against it; the evidence of a cell is limited,
so that what was there for long and has gone is forgotten after a few scans. Occupancy grids: A. Elfes, "Using
occupancy grids for mobile robot perception and navigation", 1989. Cells that were never seen count as free.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from bringup.control.command import Pose

Points: TypeAlias = NDArray[np.float64]
Cells: TypeAlias = NDArray[np.intp]

# Evidence of a hit and against one that passes; occupied is what has more than none.
HIT, PASSED, MOST = 3, -1, 12
# Farther than this (m) a small error of the heading puts a point into the wrong cell.
REACH = 6.0
# A beam clears cells up to this far (m) before what it hit.
SHY = 0.1
# How much room in m there is about all that was seen, so that a way around it can be found.
MARGIN = 1.0


@dataclass(frozen=True, slots=True)
class Grid:
    """Evidence per cell, rows along y; the cell (0, 0) has its lower left corner at `left`, `low` cells."""

    resolution: float
    left: int
    low: int
    evidence: NDArray[np.int8]

    @property
    def occupied(self) -> NDArray[np.bool_]:
        """Where obstacles are."""
        return self.evidence > 0

    def cells(self, points: Points) -> Cells:
        """Row and column of each point, shape (n, 2); they may lie outside."""
        found: Cells = np.floor(points[:, ::-1] / self.resolution).astype(np.intp) - (self.low, self.left)
        return found

    def centres(self, cells: Cells) -> Points:
        """The middles of cells in m, shape (n, 2)."""
        middles = (cells[:, ::-1] + np.array([self.left + 0.5, self.low + 0.5])) * self.resolution
        return np.asarray(middles, dtype=np.float64)

    def inside(self, cells: Cells) -> NDArray[np.bool_]:
        """Which of the cells belong to the grid."""
        return np.asarray(((cells >= 0) & (cells < np.array(self.evidence.shape))).all(axis=1))


def about(points: Points, resolution: float) -> Grid:
    """A grid that knows nothing and holds these points with room about them."""
    left, low = np.floor(points.min(axis=0) / resolution)
    return covering(Grid(resolution, int(left), int(low), np.zeros((0, 0), dtype=np.int8)), points)


def covering(grid: Grid, points: Points) -> Grid:
    """The grid, grown where points have less than the margin about them."""
    margin = math.ceil(MARGIN / grid.resolution)
    cells = grid.cells(points)
    rows, columns = grid.evidence.shape
    before = np.maximum(margin - cells.min(axis=0), 0)
    beyond = np.maximum(cells.max(axis=0) + margin + 1 - (rows, columns), 0)
    if not (before.any() or beyond.any()):
        return grid
    evidence = np.pad(grid.evidence, ((before[0], beyond[0]), (before[1], beyond[1])))
    return replace(grid, left=grid.left - int(before[1]), low=grid.low - int(before[0]), evidence=evidence)


def marked(grid: Grid, eye: Pose, hits: Points, clear: Points) -> Grid:
    """The grid after a scan, taken with the robot at `eye`: hits, and ends of beams that met nothing.

    Both are points of the robot's frame, shape (n, 2).
    """
    hits, far = _split(hits)
    ends = world(eye, np.concatenate((hits, _shortened(np.concatenate((far, clear))))))
    here = np.array([[eye.x, eye.y]])
    grid = covering(grid, np.concatenate((ends, here)))
    change = np.zeros(grid.evidence.shape, dtype=np.int16)
    passed = grid.cells(_along(here, ends, len(hits), grid.resolution))
    change[passed[:, 0], passed[:, 1]] = PASSED
    hit = grid.cells(ends[: len(hits)])
    change[hit[:, 0], hit[:, 1]] = HIT
    return replace(grid, evidence=np.clip(grid.evidence + change, -MOST, MOST).astype(np.int8))


def world(eye: Pose, points: Points) -> Points:
    """Points of the robot's frame in the odometry frame."""
    cos, sin = math.cos(eye.yaw), math.sin(eye.yaw)
    result: Points = points @ np.array([[cos, sin], [-sin, cos]]) + (eye.x, eye.y)
    return result


def _split(hits: Points) -> tuple[Points, Points]:
    near = np.einsum("ij,ij->i", hits, hits) < REACH * REACH
    return hits[near], hits[~near]


def _shortened(points: Points) -> Points:
    """The points, brought nearer where they are out of reach."""
    lengths = np.hypot(points[:, 0], points[:, 1])
    result: Points = points * np.minimum(1.0, REACH / np.maximum(lengths, REACH))[:, np.newaxis]
    return result


def _along(start: Points, ends: Points, hits: int, step: float) -> Points:
    """Points on the beams, one for each step; the first `hits` beams end a little before their ends."""
    beams = ends - start
    lengths = np.hypot(beams[:, 0], beams[:, 1])
    clear = lengths.copy()
    clear[:hits] -= SHY
    steps = np.arange(0.0, max(float(clear.max(initial=0.0)), step), step)
    directions = beams / np.maximum(lengths, step)[:, np.newaxis]
    points = start + directions[:, np.newaxis, :] * steps[:, np.newaxis]
    result: Points = points[steps < clear[:, np.newaxis]]
    return result
