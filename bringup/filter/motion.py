"""How the state moves on when nothing is measured, and the Jacobian of that motion.

Constant body acceleration and constant body angular velocity over the step. The position's derivatives with
respect to the angles come from the world displacement D = R d by the rules dR/droll d = R (ex x d),
dR/dpitch d = (Rz ey) x D and dR/dyaw d = ez x D.
"""

import math

import numpy as np

from bringup.filter.state import SIZE, Array, Indices, wrap

# Below this the rates of roll and yaw have no meaning (pitch of +-90 degrees); it only avoids a division by zero.
_SMALLEST_COSINE = 1e-9

_IDENTITY = np.eye(SIZE)


def _entries() -> Indices:
    """Flat places of the Jacobian's varying entries, in the order in which `advance` lists them."""
    places = [(row, column) for row in range(3) for column in (3, 4, 5, 6, 7, 8, 12, 13, 14)]
    places += [(3, 3), (3, 4), (3, 9), (3, 10), (3, 11)]
    places += [(4, 3), (4, 10), (4, 11)]
    places += [(5, 3), (5, 4), (5, 10), (5, 11)]
    places += [(6, 12), (7, 13), (8, 14)]
    return np.array([row * SIZE + column for row, column in places], dtype=np.intp)


_ENTRIES = _entries()


def advance(state: Array, dt: float) -> tuple[Array, Array]:
    """Move a state on by `dt` seconds; gives the new state (15) and the motion's Jacobian (15x15) at the old."""
    x, y, z, roll, pitch, yaw, vx, vy, vz, wx, wy, wz, ax, ay, az = state.tolist()
    sr, cr = math.sin(roll), math.cos(roll)
    sp, cp = math.sin(pitch), math.cos(pitch)
    sy, cy = math.sin(yaw), math.cos(yaw)
    if abs(cp) < _SMALLEST_COSINE:
        cp = math.copysign(_SMALLEST_COSINE, cp)
    tp = sp / cp
    xx, xy, xz = cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr
    yx, yy, yz = sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr
    zx, zy, zz = -sp, cp * sr, cp * cr

    half = 0.5 * dt * dt
    dx, dy, dz = vx * dt + ax * half, vy * dt + ay * half, vz * dt + az * half
    east = xx * dx + xy * dy + xz * dz
    north = yx * dx + yy * dy + yz * dz
    up = zx * dx + zy * dy + zz * dz
    swing = (sr * wy + cr * wz) * dt
    lift = (cr * wy - sr * wz) * dt

    jacobian = _IDENTITY.copy()
    # fmt: off
    jacobian.put(_ENTRIES, (
        xz * dy - xy * dz, cy * up, -north, xx * dt, xy * dt, xz * dt, xx * half, xy * half, xz * half,
        yz * dy - yy * dz, sy * up, east, yx * dt, yy * dt, yz * dt, yx * half, yy * half, yz * half,
        zz * dy - zy * dz, -cy * east - sy * north, 0.0, zx * dt, zy * dt, zz * dt, zx * half, zy * half, zz * half,
        1.0 + tp * lift, swing / (cp * cp), dt, sr * tp * dt, cr * tp * dt,
        -swing, cr * dt, -sr * dt,
        lift / cp, tp * swing / cp, sr / cp * dt, cr / cp * dt,
        dt, dt, dt,
    ))
    # fmt: on
    moved = np.array(
        (
            *(x + east, y + north, z + up),
            *(wrap(roll + wx * dt + tp * swing), wrap(pitch + lift), wrap(yaw + swing / cp)),
            *(vx + ax * dt, vy + ay * dt, vz + az * dt, wx, wy, wz, ax, ay, az),
        )
    )
    return moved, jacobian
