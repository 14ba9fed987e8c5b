"""The parameters of the simulation: one table, from which the node declares them, and what they say together."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from bringup.world.drive import Limits
from bringup.world.geometry import Pose
from bringup.world.inertial import InertialNoise
from bringup.world.layout import WORLDS
from bringup.world.odometry import WheelErrors

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

ROBOT_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
NUMBERS_PER_POSE = 3
DAY = 86400.0


class SettingsError(ValueError):
    """Parameter values that cannot be meant; the message says why."""


@dataclass(frozen=True, slots=True)
class Setting:
    """One parameter. Numbers have a range, both ends included; only changeable ones can be set while the node runs.

    An empty tuple as default stands for an array of numbers that may be left out.
    """

    name: str
    default: bool | int | float | str | tuple[str, ...]
    description: str
    low: float = -math.inf
    high: float = math.inf
    changeable: bool = False
    constraints: str = ""


@dataclass(frozen=True, slots=True)
class Settings:
    """What a run is made with."""

    world: str
    seed: int
    robots: tuple[str, ...]
    start_poses: tuple[Pose, ...]
    headless: bool
    duration: float
    speed: float
    status_period: float
    picture: str
    limits: Limits
    wheels: WheelErrors
    inertial: InertialNoise
    lidar_noise: float


TABLE = (
    Setting("world", "arena", "Which world to make.", constraints=f"One of: {', '.join(WORLDS)}"),
    Setting("seed", 1, "Seed of the world's obstacles and of all noise.", 0, 2**31 - 1),
    Setting(
        "robots",
        ("robot1", "robot2"),
        "Names of the robots, before their topics and frames.",
    ),
    Setting("start_poses", (), "x, y, yaw of each robot in turn (m, rad); empty: the world's own."),
    Setting("headless", True, "Without a window."),
    Setting(
        "duration", 0.0, "Simulated seconds after which the node ends by itself; 0: never.", 0.0, 365 * DAY
    ),
    Setting("speed", 1.0, "Simulated over real time; 0: as fast as possible.", 0.0, 1000.0, changeable=True),
    Setting("status_period", 2.0, "Real seconds between two status lines.", 0.1, DAY, changeable=True),
    Setting("picture", "", "PNG file with the driven paths, written at the end; empty: none."),
    Setting("max_linear_velocity", 0.8, "Fastest the base drives, in m/s.", 0.01, 1.0),
    Setting("max_angular_velocity", 1.5, "Fastest the base turns, in rad/s.", 0.01, 2.0),
    Setting("linear_acceleration", 1.5, "Hardest the base speeds up or brakes, in m/s^2.", 0.05, 2.5),
    Setting("angular_acceleration", 5.0, "Hardest the base starts or stops turning, in rad/s^2.", 0.05, 10.0),
    Setting(
        "left_wheel_scale",
        1.01,
        "Left wheel's radius as the odometry believes it, over the true one.",
        0.8,
        1.25,
    ),
    Setting(
        "right_wheel_scale",
        1.0,
        "Right wheel's radius as the odometry believes it, over the true one.",
        0.8,
        1.25,
    ),
    Setting(
        "wheel_slip",
        0.01,
        "Standard deviation of the share of a wheel's travel that is miscounted.",
        0.0,
        0.5,
    ),
    Setting(
        "wheel_noise", 0.002, "Standard deviation of a wheel's counted travel after 1 m, in m.", 0.0, 0.5
    ),
    Setting("gyro_noise", 0.005, "Standard deviation of each turning rate, in rad/s.", 0.0, 1.0),
    Setting("gyro_bias", 0.0002, "Constant error of each turning rate, in rad/s.", -1.0, 1.0),
    Setting("accelerometer_noise", 0.05, "Standard deviation of each acceleration, in m/s^2.", 0.0, 10.0),
    Setting("accelerometer_bias", 0.02, "Constant error of each acceleration, in m/s^2.", -10.0, 10.0),
    Setting("lidar_noise", 0.01, "Standard deviation of each range, in m.", 0.0, 1.0),
)


def settings(values: Mapping[str, Any]) -> Settings:
    """What the parameters say together.

    Raises SettingsError: a name that is no namespace or stands twice, no robot, start poses that are no triples.
    """
    return Settings(
        world=values["world"],
        seed=values["seed"],
        robots=_robots(values["robots"]),
        start_poses=_poses(values["start_poses"]),
        headless=values["headless"],
        duration=values["duration"],
        speed=values["speed"],
        status_period=values["status_period"],
        picture=values["picture"],
        limits=Limits(
            values["max_linear_velocity"],
            values["max_angular_velocity"],
            values["linear_acceleration"],
            values["angular_acceleration"],
        ),
        wheels=WheelErrors(
            values["left_wheel_scale"],
            values["right_wheel_scale"],
            values["wheel_slip"],
            values["wheel_noise"],
        ),
        inertial=InertialNoise(
            values["gyro_noise"],
            values["gyro_bias"],
            values["accelerometer_noise"],
            values["accelerometer_bias"],
        ),
        lidar_noise=values["lidar_noise"],
    )


def _robots(names: Sequence[str]) -> tuple[str, ...]:
    if not names:
        raise SettingsError("parameter 'robots' names no robot")
    for name in names:
        if not ROBOT_NAME.fullmatch(name) or "__" in name:
            raise SettingsError(f"parameter 'robots': '{name}' cannot be a namespace")
        if names.count(name) > 1:
            raise SettingsError(f"parameter 'robots': '{name}' stands there twice")
    return tuple(names)


def _poses(numbers: Sequence[float]) -> tuple[Pose, ...]:
    if len(numbers) % NUMBERS_PER_POSE:
        raise SettingsError(f"parameter 'start_poses': {len(numbers)} numbers are no triples of x, y, yaw")
    return tuple(
        Pose(*numbers[at : at + NUMBERS_PER_POSE]) for at in range(0, len(numbers), NUMBERS_PER_POSE)
    )
