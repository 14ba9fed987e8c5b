"""Transforms between frames: what has been heard of them, and what follows. Pure; times in seconds, lengths in metres.

A transform says where the child frame is in its parent. Between two frames, all transforms on the way are taken for
the latest time for which each is known, as tf2 does it for time 0.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import deque
from math import acos, asin, atan2, copysign, pi, sin, sqrt

from orchestra.dataclass import dataclass
from orchestra.fields import field

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]  # x, y, z, w

_MEMORY = 10.0
_ALIKE = 0.9995  # quaternions this close are interpolated in a straight line


@dataclass(frozen=True, slots=True)
class Transform:
    """Where a frame is in another."""

    translation: Vector
    rotation: Quaternion

    def then(self, other: Transform) -> Transform:
        """Return where a frame is whose place in this one is `other`."""
        moved = rotated(self.rotation, other.translation)
        place = (
            self.translation[0] + moved[0],
            self.translation[1] + moved[1],
            self.translation[2] + moved[2],
        )
        return Transform(place, product(self.rotation, other.rotation))

    def inverse(self) -> Transform:
        """Return where the other frame is in this one."""
        x, y, z, w = self.rotation
        back = (-x, -y, -z, w)
        moved = rotated(back, self.translation)
        return Transform((-moved[0], -moved[1], -moved[2]), back)


IDENTITY = Transform((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))


@dataclass(slots=True)
class Edge:
    """What has been heard of a frame: its parent, and where it has been in it of late."""

    parent: str
    static: bool
    history: deque[tuple[float, Transform]] = field(default_factory=deque)
    heard: int = 0

    @property
    def latest(self) -> float:
        """The last time for which it is known."""
        return self.history[-1][0]

    def at(self, time: float) -> Transform | None:
        """Return where the frame was, None for a time before all that is known."""
        if self.static or time >= self.latest:
            return self.history[-1][1]
        place = bisect_left(self.history, time, key=lambda entry: entry[0])
        after, there = self.history[place]
        if after == time:
            return there
        if place == 0:
            return None
        before, here = self.history[place - 1]
        return interpolated(here, there, (time - before) / (after - before))


class Frames:
    """All frames that have been heard of; `parents` has every parent that a frame was given."""

    def __init__(self) -> None:
        self.edges: dict[str, Edge] = {}
        self.parents: dict[str, set[str]] = {}

    def hear(self, parent: str, child: str, time: float, transform: Transform, *, static: bool) -> None:
        """Take what somebody says of a frame."""
        self.parents.setdefault(child, set()).add(parent)
        edge = self.edges.get(child)
        if edge is None or edge.parent != parent or edge.static != static or static:
            edge = self.edges[child] = Edge(parent, static, heard=0 if edge is None else edge.heard)
        edge.heard += 1
        if edge.history and time < edge.latest - _MEMORY:
            edge.history.clear()  # time has been set back
        if edge.history and time < edge.latest:
            return
        edge.history.append((time, transform))
        while edge.history[0][0] < time - _MEMORY:
            edge.history.popleft()

    def names(self) -> set[str]:
        """Return all frames."""
        return {*self.edges, *(edge.parent for edge in self.edges.values())}

    def between(self, source: str, target: str) -> tuple[float, Transform] | None:
        """Return where `target` is in `source`, and for which time; None where nothing connects them."""
        up, down = self._way(source), self._way(target)
        common = next((frame for frame in up if frame in down), None)
        if common is None:
            return None
        ways = [up[: up.index(common)], down[: down.index(common)]]
        moving = [self.edges[frame].latest for way in ways for frame in way if not self.edges[frame].static]
        time = min(moving, default=0.0)
        found = [self._along(way, time) for way in ways]
        if found[0] is None or found[1] is None:
            return None
        return time, found[0].inverse().then(found[1])

    def _way(self, frame: str) -> list[str]:
        """Return the frames from one up to the root, itself first."""
        way = [frame]
        while (edge := self.edges.get(way[-1])) is not None and edge.parent not in way:
            way.append(edge.parent)
        return way

    def _along(self, way: list[str], time: float) -> Transform | None:
        """Return where the first frame of a way is in the one above its last."""
        made = IDENTITY
        for frame in way:
            step = self.edges[frame].at(time)
            if step is None:
                return None
            made = step.then(made)
        return made


def product(first: Quaternion, second: Quaternion) -> Quaternion:
    """Return the rotation that does the second and then the first."""
    ax, ay, az, aw = first
    bx, by, bz, bw = second
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def rotated(rotation: Quaternion, vector: Vector) -> Vector:
    """Return a vector turned."""
    x, y, z, w = rotation
    turned = product(product(rotation, (*vector, 0.0)), (-x, -y, -z, w))
    return turned[:3]


def interpolated(first: Transform, second: Transform, share: float) -> Transform:
    """Return what is between two transforms: 0 is the first and 1 the second."""
    ax, ay, az = (a + (b - a) * share for a, b in zip(first.translation, second.translation, strict=True))
    return Transform((ax, ay, az), _between(first.rotation, second.rotation, share))


def _between(first: Quaternion, second: Quaternion, share: float) -> Quaternion:
    """Return the rotation between two (slerp), the shorter way round."""
    dot = sum(a * b for a, b in zip(first, second, strict=True))
    sign = copysign(1.0, dot)
    dot = min(abs(dot), 1.0)
    if dot > _ALIKE:
        weights = (1 - share, share)
    else:
        angle = acos(dot)
        weights = (sin((1 - share) * angle) / sin(angle), sin(share * angle) / sin(angle))
    x, y, z, w = (a * weights[0] + b * sign * weights[1] for a, b in zip(first, second, strict=True))
    size = sqrt(x * x + y * y + z * z + w * w)
    return (x / size, y / size, z / size, w / size)


def matrix(rotation: Quaternion) -> tuple[Vector, Vector, Vector]:
    """Return a rotation as the rows of its matrix."""
    columns = [rotated(rotation, axis) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))]
    first, second, third = zip(*columns, strict=True)
    return first, second, third


def angles(rotation: Quaternion) -> Vector:
    """Return roll, pitch and yaw in radians: turns about the fixed axes x, y and z in this order (REP 103)."""
    rows = matrix(rotation)
    sine = max(-1.0, min(1.0, -rows[2][0]))
    if abs(sine) > 1 - 1e-12:  # roll and yaw turn about one axis: all of it is told as yaw
        return 0.0, copysign(pi / 2, sine), atan2(-rows[0][1], rows[1][1])
    return atan2(rows[2][1], rows[2][2]), asin(sine), atan2(rows[1][0], rows[0][0])
