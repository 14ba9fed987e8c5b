"""How far the robot can go among the points that its lidar sees.

The robot is a disc about the middle of its axle, so that turning on the spot sweeps nothing new.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bringup.control.command import Command

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bringup.control.settings import Settings

# Least distance in m between the robot's circle and a point that it may slide along.
TIGHT = 0.03
# Speed in m/s at which two robots may share a passage that is too tight for the halves: they stop in 3 cm.
CREEP = 0.12
# A disc that already has something within its clearance shrinks to just inside it, so it can slide along.
SLACK = 0.005


def nearest(points: NDArray[np.float64]) -> float:
    """Distance from the middle of the axle to the nearest point; inf without any."""
    return float(np.sqrt(np.min(np.einsum("ij,ij->i", points, points)))) if len(points) else np.inf


def retreat(points: NDArray[np.float64]) -> Command:
    """Straight away from something inside the robot's circle, where turning could touch it."""
    closest = points[np.argmin(np.einsum("ij,ij->i", points, points))]
    return Command(-CREEP if closest[0] > 0.0 else CREEP, 0.0)


def passing_radius(points: NDArray[np.float64], settings: Settings, spare: float = 0.0) -> float:
    """Half the width that must be clear: radius and side clearance, less where it is already tighter."""
    wanted = settings.robot_radius + settings.side_clearance + spare
    return max(settings.robot_radius + TIGHT, min(wanted, nearest(points) - SLACK))


def free_travel(
    points: NDArray[np.float64], headings: NDArray[np.float64], half_width: float, distance: float
) -> NDArray[np.float64]:
    """How far the robot can drive straight in each heading before a point in its way is that near.

    Only points inside the swept strip count. Negative where one is nearer already, inf where none is.
    """
    if not len(points):
        return np.full(len(headings), np.inf)
    along = np.column_stack((np.cos(headings), np.sin(headings))) @ points.T
    aside = np.einsum("ij,ij->i", points, points) - along * along
    in_way = (along > 0.0) & (aside < half_width * half_width)
    travel = along - np.sqrt(np.maximum(distance * distance - aside, 0.0))
    result: NDArray[np.float64] = np.where(in_way, travel, np.inf).min(axis=1)
    return result


def own_half(points: NDArray[np.float64], direction: float, keep: float, body: float) -> float:
    """How far the robot may go ahead (`direction` 1) or back (-1) without leaving its half of the room.

    Whatever is seen may be a robot that drives as well. If each of two keeps a disc of radius `keep` on its
    side of the line midway between their centres, they never meet (buffered Voronoi cells: D. Zhou et al.,
    "Fast, on-line collision avoidance for dynamic vehicles using buffered Voronoi cells", 2017). `body` is
    the radius of the part of a robot that a lidar sees. A wall beside the robot hardly limits it.
    """
    along = points[:, 0] * direction
    ahead = along > 0.0
    if not ahead.any():
        return np.inf
    distances = np.sqrt(np.einsum("ij,ij->i", points[ahead], points[ahead]))
    room = (distances + body) / 2.0 - keep
    return float(np.min(np.maximum(room, 0.0) * distances / along[ahead]))
