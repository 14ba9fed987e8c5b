"""Upright things that stand in a world, as they are seen from above."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Box:
    """A cuboid: centre, half lengths and turn about the vertical, its height above the floor."""

    name: str
    x: float
    y: float
    half_x: float
    half_y: float
    yaw: float
    height: float


@dataclass(frozen=True, slots=True)
class Cylinder:
    """An upright cylinder: centre, radius, its height above the floor."""

    name: str
    x: float
    y: float
    radius: float
    height: float


Shape = Box | Cylinder


def distance(shape: Shape, x: float, y: float) -> float:
    """Metres from a point of the floor to the shape's outline, negative inside."""
    dx, dy = x - shape.x, y - shape.y
    if isinstance(shape, Cylinder):
        return math.hypot(dx, dy) - shape.radius
    cos, sin = math.cos(shape.yaw), math.sin(shape.yaw)
    out_x = abs(cos * dx + sin * dy) - shape.half_x
    out_y = abs(cos * dy - sin * dx) - shape.half_y
    return math.hypot(max(out_x, 0.0), max(out_y, 0.0)) + min(max(out_x, out_y), 0.0)
