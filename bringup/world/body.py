"""The measures of the robot: what the physics, the kinematics and the static transforms agree on."""

from __future__ import annotations

import math
from dataclasses import dataclass

WHEEL_RADIUS = 0.10
WHEEL_SEPARATION = 0.40
# How a robot stands at rest: its weight presses the tyres flat by 0.16 mm and the caster a little more.
REST_HEIGHT = 0.0998369
REST_PITCH = -0.000988
# Every part of the robot lies within this distance of the middle of its axle.
FOOTPRINT_RADIUS = 0.25


@dataclass(frozen=True, slots=True)
class Mount:
    """A frame that is fixed to another one: its origin there in metres, its turn in radians (fixed axes x, y, z)."""

    parent: str
    child: str
    x: float
    y: float
    z: float
    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0


BASE = Mount("base_footprint", "base_link", 0.0, 0.0, WHEEL_RADIUS)
IMU = Mount("base_link", "imu_link", 0.0, 0.0, 0.05)
LASER = Mount("base_link", "laser", 0.0, 0.0, 0.20)
LEFT_WHEEL = Mount("base_link", "left_wheel", 0.0, WHEEL_SEPARATION / 2, 0.0)
RIGHT_WHEEL = Mount("base_link", "right_wheel", 0.0, -WHEEL_SEPARATION / 2, 0.0)
CASTER = Mount("base_link", "caster", -0.18, 0.0, -0.06)
# The root comes first, then everything that hangs on it.
MOUNTS = (BASE, IMU, LASER, LEFT_WHEEL, RIGHT_WHEEL, CASTER)
# Where images are taken: x forwards, and as REP 103 has it for cameras, z forwards and x to the right.
CAMERA = Mount("base_link", "camera_link", 0.19, 0.0, 0.08)
CAMERAS = (
    CAMERA,
    Mount("camera_link", "camera_optical_frame", 0.0, 0.0, 0.0, -math.pi / 2, 0.0, -math.pi / 2),
)
# The camera's whole angle from top to bottom, in degrees.
CAMERA_FOVY = 60.0
