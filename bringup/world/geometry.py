"""Poses in the plane, in metres and radians, x forward, y left, yaw counter-clockwise (REP 103)."""

from __future__ import annotations

import math
from typing import NamedTuple


class Pose(NamedTuple):
    """A place and a heading. A tuple, because several are made in each tick: a frozen dataclass takes twice as long."""

    x: float
    y: float
    yaw: float


def wrap(angle: float) -> float:
    """The same angle within (-pi, pi]."""
    wrapped = math.remainder(angle, math.tau)
    return math.pi if wrapped == -math.pi else wrapped


def compose(origin: Pose, local: Pose) -> Pose:
    """The pose that is `local` when seen from `origin`, in the frame of `origin`'s own numbers."""
    cos, sin = math.cos(origin.yaw), math.sin(origin.yaw)
    return Pose(
        origin.x + cos * local.x - sin * local.y,
        origin.y + sin * local.x + cos * local.y,
        wrap(origin.yaw + local.yaw),
    )


def relative(origin: Pose, pose: Pose) -> Pose:
    """How `pose` looks from `origin`: the inverse of `compose`."""
    dx, dy = pose.x - origin.x, pose.y - origin.y
    cos, sin = math.cos(origin.yaw), math.sin(origin.yaw)
    return Pose(cos * dx + sin * dy, cos * dy - sin * dx, wrap(pose.yaw - origin.yaw))


def between(before: Pose, after: Pose, share: float) -> Pose:
    """The pose at `share` (0 to 1) of the way, turning through the smaller angle."""
    return Pose(
        before.x + share * (after.x - before.x),
        before.y + share * (after.y - before.y),
        wrap(before.yaw + share * wrap(after.yaw - before.yaw)),
    )


def yaw_of(w: float, x: float, y: float, z: float) -> float:
    """Heading of a unit quaternion: the first of its yaw, pitch, roll angles."""
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
