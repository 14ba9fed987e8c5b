"""The differential drive: its limits, and what becomes of a velocity command."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from bringup.world.body import WHEEL_RADIUS, WHEEL_SEPARATION


class Twist(NamedTuple):
    """Forward velocity in m/s and turning rate in rad/s. A tuple, as `bringup.world.geometry.Pose` is."""

    linear: float
    angular: float


STILL = Twist(0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Limits:
    """What the base can do, in m/s, rad/s, m/s^2 and rad/s^2. Beyond 1.2 m/s and 4 m/s^2 it would tip."""

    linear_velocity: float = 0.8
    angular_velocity: float = 1.5
    linear_acceleration: float = 1.5
    angular_acceleration: float = 5.0
    linear_deceleration: float = 4.0


def limited(command: Twist, limits: Limits) -> Twist:
    """The part of a command that the base obeys; a command that is no number is an order to stand still."""
    if not (math.isfinite(command.linear) and math.isfinite(command.angular)):
        return STILL
    return Twist(
        _clamp(command.linear, limits.linear_velocity), _clamp(command.angular, limits.angular_velocity)
    )


def ramped(current: Twist, target: Twist, limits: Limits, dt: float) -> Twist:
    """What can be reached from `current` on the way to `target` within `dt` seconds."""
    braking = target.linear * current.linear < 0.0 or abs(target.linear) < abs(current.linear)
    hardest = limits.linear_deceleration if braking else limits.linear_acceleration
    return Twist(
        current.linear + _clamp(target.linear - current.linear, hardest * dt),
        current.angular + _clamp(target.angular - current.angular, limits.angular_acceleration * dt),
    )


def wheel_speeds(twist: Twist) -> tuple[float, float]:
    """Left and right wheel in rad/s that give this motion without slip."""
    turn = 0.5 * WHEEL_SEPARATION * twist.angular
    return (twist.linear - turn) / WHEEL_RADIUS, (twist.linear + turn) / WHEEL_RADIUS


def _clamp(value: float, bound: float) -> float:
    return max(-bound, min(bound, value))
