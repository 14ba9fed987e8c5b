"""The map of a run's world as plain facts: what stands there, and where the robots have started."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from bringup.world.shapes import Box, Cylinder, Shape

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bringup.world.layout import Layout


def facts(layout: Layout) -> dict[str, Any]:
    """The world, its shapes and start poses, as JSON has them."""
    return {
        "world": layout.name,
        "seed": layout.seed,
        "shapes": [asdict(shape) for shape in (*layout.walls, *layout.obstacles)],
        "starts": {start.robot: (start.pose.x, start.pose.y, start.pose.yaw) for start in layout.starts},
    }


def shapes(told: Sequence[dict[str, Any]]) -> list[Shape]:
    """The shapes that `facts` has told."""
    return [Cylinder(**shape) if "radius" in shape else Box(**shape) for shape in told]
