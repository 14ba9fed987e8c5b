"""From a layout to MuJoCo's model: the template rendered and loaded, and where each robot's numbers are in it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from numpy.typing import NDArray

from bringup.world.body import (
    CAMERA,
    CAMERA_FOVY,
    FOOTPRINT_RADIUS,
    MOUNTS,
    REST_HEIGHT,
    REST_PITCH,
    WHEEL_RADIUS,
)
from bringup.world.drive import Twist
from bringup.world.geometry import Pose, yaw_of
from bringup.world.layout import Layout
from bringup.world.physics import mujoco

WORLDS = Path(__file__).parent.parent / "worlds"
TEMPLATE = "world.xml.j2"
COLOURS = ("0.15 0.40 0.75 1", "0.80 0.30 0.20 1", "0.20 0.60 0.35 1", "0.55 0.35 0.70 1")
# Physics steps in seconds, and how many of them make a tick: the grid on which every message lies.
TIMESTEP = 0.005
STEPS_PER_TICK = 2
TICKS_PER_SECOND = 100
# Owners of a geom that are no robot.
FLOOR = -2
THING = -1


@dataclass(frozen=True, slots=True)
class Robot:
    """Where one robot is in the model: indices into MuJoCo's arrays. `imu` holds turning rates, then accelerations."""

    name: str
    start: Pose
    body: int
    laser: int
    position: int
    velocity: int
    wheels: tuple[int, int]
    spins: tuple[int, int]
    motors: tuple[int, int]
    imu: slice


@dataclass(frozen=True, slots=True)
class Model:
    """A loaded world. `owners` tells for each geom the number of its robot, or FLOOR or THING."""

    layout: Layout
    physics: Any
    robots: tuple[Robot, ...]
    owners: NDArray[np.int64]


def render(layout: Layout) -> str:
    """The world as MJCF."""
    return (
        templates()
        .get_template(TEMPLATE)
        .render(
            layout=layout,
            timestep=TIMESTEP,
            wheel_radius=WHEEL_RADIUS,
            footprint_radius=FOOTPRINT_RADIUS,
            mounts={mount.child: mount for mount in MOUNTS},
            camera=CAMERA,
            camera_fovy=CAMERA_FOVY,
            colours=COLOURS,
        )
    )


def templates() -> Environment:
    """The templates of worlds and robots."""
    return Environment(loader=FileSystemLoader(WORLDS), undefined=StrictUndefined, autoescape=True)


def load(layout: Layout) -> Model:
    """The world as MuJoCo's model, ready to be stepped."""
    physics = mujoco.MjModel.from_xml_string(render(layout))
    robots = tuple(_robot(physics, start.robot, start.pose) for start in layout.starts)
    return Model(layout, physics, robots, _owners(physics, [robot.name for robot in robots]))


class Moment(NamedTuple):
    """MuJoCo's numbers at one tick as plain ones, under its names: whoever asks one by one pays for numpy each time."""

    qpos: list[float]
    qvel: list[float]
    sensordata: list[float]


def moment(data: Any) -> Moment:  # noqa: ANN401 - MjData has no type
    """The numbers of this moment."""
    return Moment(data.qpos.tolist(), data.qvel.tolist(), data.sensordata.tolist())


def pose(data: Any, robot: Robot) -> Pose:  # noqa: ANN401 - MjData has no type
    """Where the robot is now, in world coordinates."""
    return placed(moment(data), robot)


def placed(moment: Moment, robot: Robot) -> Pose:
    """Where the robot was at a moment, in world coordinates."""
    at = robot.position
    x, y, _, w, i, j, k = moment.qpos[at : at + 7]
    return Pose(x, y, yaw_of(w, i, j, k))


def place(data: Any, robot: Robot, pose: Pose) -> None:  # noqa: ANN401 - MjData has no type
    """Put the robot somewhere, at rest; the physics has to be told by `mj_forward`."""
    at, moving = robot.position, robot.velocity
    cos, sin = math.cos(pose.yaw / 2), math.sin(pose.yaw / 2)
    ahead, nod = math.cos(REST_PITCH / 2), math.sin(REST_PITCH / 2)
    data.qpos[at : at + 7] = pose.x, pose.y, REST_HEIGHT, cos * ahead, -sin * nod, cos * nod, sin * ahead
    data.qvel[moving : moving + 6] = 0.0
    for wheel in robot.spins:
        data.qvel[wheel] = 0.0


def wheel_speeds(data: Any, robot: Robot) -> tuple[float, float]:  # noqa: ANN401 - MjData has no type
    """How fast the left and the right wheel turn, in rad/s."""
    return float(data.qvel[robot.spins[0]]), float(data.qvel[robot.spins[1]])


def twist(data: Any, robot: Robot, heading: float) -> tuple[Twist, float]:  # noqa: ANN401 - MjData has no type
    """How the robot moves now, in its own frame, and its velocity to the left in m/s."""
    return moving(moment(data), robot, heading)


def moving(moment: Moment, robot: Robot, heading: float) -> tuple[Twist, float]:
    """How the robot moved at a moment, in its own frame, and its velocity to the left in m/s."""
    at = robot.velocity
    vx, vy, _, _, _, turn = moment.qvel[at : at + 6]
    cos, sin = math.cos(heading), math.sin(heading)
    return Twist(cos * vx + sin * vy, turn), cos * vy - sin * vx


def wheel_angles(data: Any, robot: Robot) -> tuple[float, float]:  # noqa: ANN401 - MjData has no type
    """How far the left and the right wheel have turned since the start, in radians."""
    return float(data.qpos[robot.wheels[0]]), float(data.qpos[robot.wheels[1]])


def _robot(physics: Any, name: str, start: Pose) -> Robot:  # noqa: ANN401 - MjModel has no type
    base = physics.joint(f"{name}/base")
    wheels = [physics.joint(f"{name}/{side}_wheel") for side in ("left", "right")]
    motors = [physics.actuator(f"{name}/{side}_wheel") for side in ("left", "right")]
    return Robot(
        name=name,
        start=start,
        body=physics.body(f"{name}/base_link").id,
        laser=physics.site(f"{name}/laser").id,
        position=int(base.qposadr[0]),
        velocity=int(base.dofadr[0]),
        wheels=(int(wheels[0].qposadr[0]), int(wheels[1].qposadr[0])),
        spins=(int(wheels[0].dofadr[0]), int(wheels[1].dofadr[0])),
        motors=(motors[0].id, motors[1].id),
        imu=_imu(physics, name),
    )


def _imu(physics: Any, robot: str) -> slice:  # noqa: ANN401 - MjModel has no type
    """Where the gyroscope's three numbers are; the accelerometer's follow, as in the template."""
    first = int(physics.sensor(f"{robot}/gyro").adr[0])
    return slice(first, first + 6)


def _owners(physics: Any, robots: list[str]) -> NDArray[np.int64]:  # noqa: ANN401 - MjModel has no type
    owners = np.full(physics.ngeom, THING)
    owners[physics.geom("floor").id] = FLOOR
    for geom in range(physics.ngeom):
        name = physics.geom(geom).name.partition("/")[0]
        if name in robots:
            owners[geom] = robots.index(name)
    return owners
