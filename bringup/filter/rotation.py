"""Rotations as 3x3 matrices, quaternions (x, y, z, w) and fixed-axis roll, pitch, yaw: R = Rz Ry Rx."""

import math
from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from bringup.filter.state import Array

Quaternion: TypeAlias = tuple[float, float, float, float]
Vector: TypeAlias = tuple[float, float, float]
Rows: TypeAlias = tuple[Vector, Vector, Vector]

_GIMBAL_LOCK = 1.0 - 1e-12
_NEARLY_PARALLEL = 0.9995


def matrix_from_rpy(roll: float, pitch: float, yaw: float) -> Array:
    """Rotation matrix of roll, pitch and yaw in radians."""
    sr, cr = math.sin(roll), math.cos(roll)
    sp, cp = math.sin(pitch), math.cos(pitch)
    sy, cy = math.sin(yaw), math.cos(yaw)
    return np.array(
        (
            (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
            (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
            (-sp, cp * sr, cp * cr),
        )
    )


def matrix_from_quaternion(quaternion: Quaternion) -> Array:
    """Rotation matrix of a quaternion of any length; the zero quaternion counts as no rotation."""
    x, y, z, w = quaternion
    square = x * x + y * y + z * z + w * w
    if square == 0.0:
        return np.eye(3)
    s = 2.0 / square
    return np.array(
        (
            (1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)),
            (s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)),
            (s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)),
        )
    )


def rpy_from_matrix(matrix: Array) -> Vector:
    """Roll, pitch and yaw of a rotation matrix; at a pitch of +-90 degrees the roll is taken as zero."""
    (m00, m01, _), (m10, m11, _), (m20, m21, m22) = matrix.tolist()
    if abs(m20) > _GIMBAL_LOCK:
        return 0.0, math.copysign(math.pi / 2.0, -m20), math.atan2(-m01, m11)
    return math.atan2(m21, m22), math.asin(-m20), math.atan2(m10, m00)


def rpy_from_quaternion(quaternion: Quaternion) -> Vector:
    """Roll, pitch and yaw of a quaternion of any length, as `rpy_from_matrix` gives them; zero is no rotation."""
    x, y, z, w = quaternion
    square = x * x + y * y + z * z + w * w
    if square == 0.0:
        return 0.0, 0.0, 0.0
    s = 2.0 / square
    m20 = s * (x * z - w * y)
    if abs(m20) > _GIMBAL_LOCK:
        yaw = math.atan2(s * (w * z - x * y), 1.0 - s * (x * x + z * z))
        return 0.0, math.copysign(math.pi / 2.0, -m20), yaw
    return (
        math.atan2(s * (y * z + w * x), 1.0 - s * (x * x + y * y)),
        math.asin(-m20),
        math.atan2(s * (x * y + w * z), 1.0 - s * (y * y + z * z)),
    )


def up_seen_by(quaternion: Quaternion) -> Vector:
    """The world's unit vector upwards, in the axes of a body with this attitude."""
    x, y, z, w = quaternion
    square = x * x + y * y + z * z + w * w
    if square == 0.0:
        return 0.0, 0.0, 1.0
    s = 2.0 / square
    return s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)


def quaternion_from_rpy(roll: float, pitch: float, yaw: float) -> Quaternion:
    """Unit quaternion of roll, pitch and yaw in radians."""
    sr, cr = math.sin(roll / 2.0), math.cos(roll / 2.0)
    sp, cp = math.sin(pitch / 2.0), math.cos(pitch / 2.0)
    sy, cy = math.sin(yaw / 2.0), math.cos(yaw / 2.0)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def interpolate(start: Quaternion, end: Quaternion, fraction: float) -> Quaternion:
    """Spherical interpolation between two unit quaternions along the shorter arc."""
    dot = sum(a * b for a, b in zip(start, end, strict=True))
    sign = -1.0 if dot < 0.0 else 1.0
    dot *= sign
    if dot > _NEARLY_PARALLEL:
        first, second = 1.0 - fraction, fraction
    else:
        angle = math.acos(dot)
        first = math.sin((1.0 - fraction) * angle) / math.sin(angle)
        second = math.sin(fraction * angle) / math.sin(angle)
    x, y, z, w = (first * a + second * sign * b for a, b in zip(start, end, strict=True))
    return x, y, z, w


def six_dimensional(rotation: Array) -> Array:
    """The 6x6 block-diagonal matrix that turns a pose or twist covariance by a rotation."""
    both = np.zeros((6, 6))
    both[:3, :3] = rotation
    both[3:, 3:] = rotation
    return both


def cross_matrix(vector: Array) -> Array:
    """The matrix that, times u, gives the cross product `vector x u`."""
    x, y, z = vector.tolist()
    return np.array(((0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)))


def rows_of(matrix: Array) -> Rows:
    """A 3x3 matrix as plain numbers, row by row: at this size they are several times faster than arrays."""
    first, second, third = (vector(row) for row in matrix.tolist())
    return first, second, third


def vector(numbers: Sequence[float]) -> Vector:
    """Three numbers as a vector."""
    x, y, z = numbers
    return x, y, z


def product(rows: Rows, vector: Vector) -> Vector:
    """A 3x3 matrix times a vector."""
    (a, b, c), (d, e, f), (g, h, i) = rows
    x, y, z = vector
    return a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + i * z


def cross(first: Vector, second: Vector) -> Vector:
    """Cross product of two vectors."""
    a, b, c = first
    x, y, z = second
    return b * z - c * y, c * x - a * z, a * y - b * x
