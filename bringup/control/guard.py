"""Limits a wanted velocity so that the robot stops before whatever it sees, in every mode.

Three limits, the least of which holds: the straight way in the direction of motion ends `obstacle_distance`
before a point inside the swept strip (with hysteresis: once stopped, the way must be clear by
`obstacle_hysteresis` more); the robot stays in its own half between itself and anything that might drive
towards it, but for a creeping speed; it does not turn while something is inside its circle.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bringup.control.clearance import CREEP, free_travel, nearest, own_half, passing_radius
from bringup.control.command import Command
from bringup.control.ramp import stoppable_speed

__all__ = ["BODY", "CREEP", "LAG", "SPARE", "Guarded", "guarded"]

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bringup.control.settings import Settings

# From a decision to the wheels: one period of the loop and the lag of the drive.
LAG = 0.15
# What a scan shows of another robot, and what is kept on top of the radius for its movement since the scan.
BODY = 0.15
SPARE = 0.08


@dataclass(frozen=True, slots=True)
class Guarded:
    """A velocity that is safe to approach, and whether the way is held to be blocked."""

    command: Command
    blocked: bool


def guarded(
    wanted: Command, points: NDArray[np.float64], settings: Settings, *, age: float, blocked: bool
) -> Guarded:
    """The wanted velocity within the limits of what the points allow.

    `age` is how old the points are in seconds, `blocked` the answer of the tick before.
    """
    direction = -1.0 if wanted.linear < 0.0 else 1.0
    reaction = age + LAG
    gap = _gap(wanted, direction, points, settings, reaction)
    blocked = gap < (settings.obstacle_hysteresis if blocked else 0.0)
    fastest = 0.0 if blocked else stoppable_speed(gap, settings.max_linear_deceleration, reaction)
    half = own_half(points, direction, settings.robot_radius + SPARE, BODY)
    shared = max(CREEP, stoppable_speed(half, settings.max_linear_deceleration, reaction))
    speed = min(abs(wanted.linear), fastest, shared)
    turns = nearest(points) >= settings.robot_radius
    return Guarded(Command(direction * speed, wanted.angular if turns else 0.0), blocked)


def _gap(
    wanted: Command, direction: float, points: NDArray[np.float64], settings: Settings, reaction: float
) -> float:
    """Free way in m over all headings that the robot can have before it stands."""
    turned = wanted.angular * (reaction + abs(wanted.linear) / settings.max_linear_deceleration)
    backwards = np.pi if direction < 0.0 else 0.0
    headings = backwards + np.array([0.0, turned / 2.0]) * (abs(wanted.linear) > 0.0)
    half_width = passing_radius(points, settings)
    distance = max(settings.obstacle_distance, half_width)
    return float(free_travel(points, headings, half_width, distance).min())
