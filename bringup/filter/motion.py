"""How the state moves on when nothing is measured, and the Jacobian of that motion.

Constant body acceleration and constant body angular velocity over the step. The position's derivatives with
respect to the angles come from the world displacement D = R d by the rules dR/droll d = R (ex x d),
dR/dpitch d = (Rz ey) x D and dR/dyaw d = ez x D.
"""

import math
from struct import Struct

import numpy as np

from bringup.filter.state import SIZE, Array, wrap

# Below this the rates of roll and yaw have no meaning (pitch of +-90 degrees); it only avoids a division by zero.
_SMALLEST_COSINE = 1e-9

# One row per line: what varies (+), what is one (1), what is zero (.). Rates and accelerations stay as they are.
_PATTERN = """
1..++++++...+++
.1.++++++...+++
..1++++++...+++
...++....+++...
...+1.....++...
...++1....++...
......1.....+..
.......1.....+.
........1.....+
.........1.....
..........1....
...........1...
............1..
.............1.
..............1
"""

# Doubles are written where something stands, and eight bytes of zero, which are 0.0, where nothing does: several
# times faster than putting 42 entries into a copy of the identity.
_JACOBIAN = Struct("=" + "".join("8x" if sign == "." else "d" for sign in "".join(_PATTERN.split())))
_STATE = Struct(f"={SIZE}d")


def advance(state: Array, dt: float) -> tuple[Array, Array]:
    """Move a state on by `dt` seconds; gives the new state (15) and the motion's Jacobian (15x15) at the old.

    Neither can be written to.
    """
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

    # fmt: off
    jacobian = _JACOBIAN.pack(
        1.0, xz * dy - xy * dz, cy * up, -north, xx * dt, xy * dt, xz * dt, xx * half, xy * half, xz * half,
        1.0, yz * dy - yy * dz, sy * up, east, yx * dt, yy * dt, yz * dt, yx * half, yy * half, yz * half,
        1.0, zz * dy - zy * dz, -cy * east - sy * north, 0.0,
        zx * dt, zy * dt, zz * dt, zx * half, zy * half, zz * half,
        1.0 + tp * lift, swing / (cp * cp), dt, sr * tp * dt, cr * tp * dt,
        -swing, 1.0, cr * dt, -sr * dt,
        lift / cp, tp * swing / cp, 1.0, sr / cp * dt, cr / cp * dt,
        1.0, dt, 1.0, dt, 1.0, dt,
        1.0, 1.0, 1.0, 1.0, 1.0, 1.0,
    )
    moved = _STATE.pack(
        x + east, y + north, z + up,
        wrap(roll + wx * dt + tp * swing), wrap(pitch + lift), wrap(yaw + swing / cp),
        vx + ax * dt, vy + ay * dt, vz + az * dt, wx, wy, wz, ax, ay, az,
    )
    # fmt: on
    return np.frombuffer(moved), np.frombuffer(jacobian).reshape(SIZE, SIZE)
