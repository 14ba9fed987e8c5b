"""The 15 state variables: their order, their names and how angles wrap.

Pose of the base in the world frame, then velocities and linear accelerations in the base's own axes (SI units,
REP-103). The three angular velocities are the components of omega, not rates of the Euler angles. Every
15-entry parameter uses this order.
"""

import math
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

Array: TypeAlias = npt.NDArray[np.float64]
Indices: TypeAlias = npt.NDArray[np.intp]

NAMES = (
    "X",
    "Y",
    "Z",
    "ROLL",
    "PITCH",
    "YAW",
    "X_VELOCITY",
    "Y_VELOCITY",
    "Z_VELOCITY",
    "ROLL_VELOCITY",
    "PITCH_VELOCITY",
    "YAW_VELOCITY",
    "X_ACCELERATION",
    "Y_ACCELERATION",
    "Z_ACCELERATION",
)
SIZE = len(NAMES)
(X, Y, Z, ROLL, PITCH, YAW, VX, VY, VZ, VROLL, VPITCH, VYAW, AX, AY, AZ) = range(SIZE)

POSE = slice(X, VX)
ORIENTATION = slice(ROLL, VX)
TWIST = slice(VX, AX)
LINEAR = slice(VX, VROLL)
ANGULAR = slice(VROLL, AX)
ACCELERATION = slice(AX, SIZE)

# What a robot on a plane cannot do; `two_d_mode` holds these at zero.
OUT_OF_PLANE = (Z, ROLL, PITCH, VZ, VROLL, VPITCH, AZ)

_TURN = 2.0 * math.pi


def wrap(angle: float) -> float:
    """Bring an angle in radians into (-pi, pi]."""
    if -math.pi < angle <= math.pi:
        return angle
    return angle - _TURN * math.ceil((angle - math.pi) / _TURN)


def wrap_orientation(state: Array) -> None:
    """Wrap roll, pitch and yaw of a state vector in place."""
    for index, angle in enumerate(state[ORIENTATION].tolist(), ROLL):
        if not -math.pi < angle <= math.pi:
            state[index] = wrap(angle)
