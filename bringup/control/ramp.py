"""How fast a velocity may change, and how fast one may drive to stop in time."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from bringup.control.command import Command

if TYPE_CHECKING:
    from bringup.control.settings import Settings


def ramped(current: Command, wanted: Command, settings: Settings, elapsed: float) -> Command:
    """The velocity nearest to the wanted one that can be reached in `elapsed` seconds."""
    linear = _rises(current.linear, wanted.linear)
    angular = _rises(current.angular, wanted.angular)
    rate = settings.max_linear_acceleration if linear else settings.max_linear_deceleration
    turn = settings.max_angular_acceleration if angular else settings.max_angular_deceleration
    return Command(
        _towards(current.linear, wanted.linear, rate * elapsed),
        _towards(current.angular, wanted.angular, turn * elapsed),
    )


def braked(current: Command, settings: Settings, elapsed: float) -> Command:
    """The velocity after `elapsed` seconds of an emergency stop."""
    return Command(
        _towards(current.linear, 0.0, settings.emergency_deceleration * elapsed),
        _towards(current.angular, 0.0, settings.emergency_angular_deceleration * elapsed),
    )


def stopping_distance(speed: float, deceleration: float, reaction: float) -> float:
    """Way in m that a robot at this speed still makes: unchanged for `reaction` seconds, then braking."""
    return speed * reaction + speed * speed / (2.0 * deceleration)


def stoppable_speed(distance: float, deceleration: float, reaction: float) -> float:
    """The greatest speed whose `stopping_distance` is no more than this distance; 0 without distance."""
    if distance <= 0.0:
        return 0.0
    return deceleration * (math.sqrt(reaction * reaction + 2.0 * distance / deceleration) - reaction)


def _rises(current: float, wanted: float) -> bool:
    return abs(wanted) > abs(current) and wanted * current >= 0.0


def _towards(current: float, wanted: float, most: float) -> float:
    return current + min(max(wanted - current, -most), most)
