"""A robot as URDF, made of the same parts as its body in the world."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bringup.world.body import CAMERAS, FOOTPRINT_RADIUS, MOUNTS, WHEEL_RADIUS
from bringup.world.model import COLOURS, templates
from bringup.world.physics import mujoco

if TYPE_CHECKING:
    from typing import Any

    from bringup.world.model import Model

TEMPLATE = "robot.urdf.j2"
TURNING = ("left_wheel", "right_wheel")
# In the order of the wheels everywhere else.
JOINTS = tuple(f"{wheel}_joint" for wheel in TURNING)
BODIES = ("base_link", "left_wheel", "right_wheel", "caster")


def describe(model: Model, number: int) -> str:
    """The URDF of one robot; its links are called as its frames are."""
    robot = model.robots[number].name
    mounts = (*MOUNTS, *CAMERAS)
    return (
        templates()
        .get_template(TEMPLATE)
        .render(
            robot=robot,
            colour=COLOURS[number % len(COLOURS)],
            wheel_radius=WHEEL_RADIUS,
            footprint_radius=FOOTPRINT_RADIUS,
            mounts={mount.child: mount for mount in mounts},
            all=mounts,
            frames=[mount for mount in mounts if mount.child not in BODIES],
            turning=TURNING,
            weights={body: _weight(model.physics.body(f"{robot}/{body}")) for body in BODIES},
        )
    )


def _weight(body: Any) -> dict[str, Any]:  # noqa: ANN401 - MuJoCo's views have no types
    """Mass in kg, centre of mass in m, and inertia about it in kg m^2, along the axes of the body."""
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, body.iquat)
    axes = turn.reshape(3, 3)
    inertia = axes @ np.diag(body.inertia) @ axes.T
    return {"mass": float(body.mass[0]), "at": body.ipos.tolist(), "inertia": inertia.tolist()}
