"""The accelerations that a velocity command makes the robot take, within its limits."""

import numpy as np

from bringup.filter.settings import Control
from bringup.filter.state import ACCELERATION, ANGULAR, TWIST, Array

_SIGN_TOLERANCE = 0.01
_LINEAR_AXES = 3


def accelerations(control: Control, velocities: tuple[float, ...], command: tuple[float, ...]) -> list[float]:
    """Acceleration of each of the six axes towards its commanded velocity (m/s^2, rad/s^2).

    A command of the other sign is approached by braking to zero first.
    """
    return [
        _acceleration(velocity, wanted, driving, braking)
        for velocity, wanted, driving, braking in zip(
            velocities,
            command,
            zip(control.acceleration_limits, control.acceleration_gains, strict=True),
            zip(control.deceleration_limits, control.deceleration_gains, strict=True),
            strict=True,
        )
    ]


def _acceleration(
    velocity: float, wanted: float, driving: tuple[float, float], braking: tuple[float, float]
) -> float:
    same_sign = abs(wanted - velocity) <= abs(wanted) + _SIGN_TOLERANCE
    setpoint = wanted if same_sign else 0.0
    limit, gain = braking if abs(setpoint) < abs(velocity) else driving
    return min(max(gain * (wanted - velocity), -limit), limit)


def controlled(state: Array, control: Control, command: tuple[float, ...], dt: float) -> Array:
    """Give the state that a command acts upon: angular velocities changed, linear accelerations replaced."""
    state = state.copy()
    wanted = accelerations(control, tuple(state[TWIST].tolist()), command)
    axes = np.array(control.axes)
    linear, angular = axes[:_LINEAR_AXES], axes[_LINEAR_AXES:]
    state[ANGULAR][angular] += np.array(wanted[_LINEAR_AXES:])[angular] * dt
    state[ACCELERATION][linear] = np.array(wanted[:_LINEAR_AXES])[linear]
    return state
