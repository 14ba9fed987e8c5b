"""What the parameters say together: the settings of a run and those of each of its robots."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any

from bringup.world.drive import Limits
from bringup.world.geometry import Pose
from bringup.world.inertial import InertialNoise
from bringup.world.lidar import LidarErrors
from bringup.world.odometry import WheelErrors
from bringup.world.table import BY_NAME, EACH, TABLE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bringup.world.table import Setting

__all__ = ["TABLE", "Robot", "RobotSettings", "Settings", "SettingsError", "checked", "nearest", "settings"]
ROBOT_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
NUMBERS_PER_POSE = 3


class SettingsError(ValueError):
    """Parameter values that cannot be meant; the message says why."""


@dataclass(frozen=True, slots=True)
class RobotSettings:
    """What one robot is made with: its base, its sensors' errors, their messages per simulated second."""

    limits: Limits = field(default_factory=Limits)
    command_timeout: float = 0.2
    wheels: WheelErrors = field(default_factory=WheelErrors)
    inertial: InertialNoise = field(default_factory=InertialNoise)
    lidar: LidarErrors = field(default_factory=LidarErrors)
    odometry_rate: float = 50.0
    imu_rate: float = 100.0
    scan_rate: float = 10.0


@dataclass(frozen=True, slots=True)
class Robot:
    """A robot as a file describes it: where it stands at first, if told, and the values that are its own."""

    name: str
    start: Pose | None = None
    own: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Settings:
    """What a run is made with; `each` has one entry for each of the `robots`."""

    world: str
    seed: int
    robots: tuple[str, ...]
    start_poses: tuple[Pose | None, ...]
    world_frame: str
    headless: bool
    duration: float
    speed: float
    unthrottled_ticks: int
    filter_lag: float
    paused: bool
    lockstep_ticks: int | None
    script: str
    status_period: float
    picture: str
    record: str
    camera_rate: float
    camera_size: tuple[int, int]
    each: tuple[RobotSettings, ...]


def settings(values: Mapping[str, Any], described: Sequence[Robot] = ()) -> Settings:
    """What these parameter values mean, with the robots of a file, if there is one, and what is their own.

    Raises SettingsError.
    """
    robots = _robots([robot.name for robot in described] or _names(values["robots"]))
    own = {robot.name: robot.own for robot in described}
    poses = _poses(values["start_poses"] or ())
    return Settings(
        world=values["world"],
        seed=values["seed"],
        robots=robots,
        start_poses=poses or tuple(robot.start for robot in described),
        world_frame=values["world_frame"],
        headless=values["headless"],
        duration=values["duration"],
        speed=values["speed"],
        unthrottled_ticks=values["unthrottled_ticks"],
        filter_lag=values["filter_lag"],
        paused=values["paused"],
        lockstep_ticks=values["lockstep_ticks"] if values["lockstep"] else None,
        script=values["script"],
        status_period=values["status_period"],
        picture=values["picture"],
        record=values["record"],
        camera_rate=values["camera_rate"],
        camera_size=(values["camera_width"], values["camera_height"]),
        each=tuple(_of_robot({**values, **own.get(name, {})}, name) for name in robots),
    )


def checked(setting: Setting, value: Any) -> Any:  # noqa: ANN401 - a parameter's value
    """A robot's own value in its setting's type. Raises SettingsError: of another type, out of range."""
    whole = not isinstance(setting.default, float)
    if isinstance(value, bool) or not isinstance(value, int if whole else int | float):
        raise SettingsError(f"'{setting.name}' is no {'whole number' if whole else 'number'}: {value!r}")
    if not setting.low <= value <= setting.high:
        raise SettingsError(
            f"'{setting.name}' is out of range: {value:g} is not from {setting.low:g} to {setting.high:g}"
        )
    return value if whole else float(value)


def nearest(name: str, *, each: bool = False) -> str | None:
    """The parameter that was probably meant, if any; `each`: among those that a robot can have of its own."""
    known = [setting.name for setting in EACH] if each else list(BY_NAME)
    close = get_close_matches(name, known, 1, 0.75)
    return close[0] if close else None


def _of_robot(values: Mapping[str, Any], name: str) -> RobotSettings:
    lidar = LidarErrors(
        values["lidar_noise"], values["lidar_dropout"], values["lidar_range_min"], values["lidar_range_max"]
    )
    if lidar.range_min >= lidar.range_max:
        raise SettingsError(
            f"the lidar of {name} would see nothing: lidar_range_min {lidar.range_min:g} "
            f"is not below lidar_range_max {lidar.range_max:g}"
        )
    return RobotSettings(
        limits=Limits(
            values["max_linear_velocity"],
            values["max_angular_velocity"],
            values["linear_acceleration"],
            values["angular_acceleration"],
            values["linear_deceleration"],
        ),
        command_timeout=values["command_timeout"],
        wheels=WheelErrors(
            values["left_wheel_scale"],
            values["right_wheel_scale"],
            values["wheel_slip"],
            values["wheel_noise"],
            values["encoder_counts"],
        ),
        inertial=InertialNoise(
            values["gyro_noise"],
            values["gyro_bias"],
            values["accelerometer_noise"],
            values["accelerometer_bias"],
            values["gyro_bias_walk"],
            values["accelerometer_bias_walk"],
        ),
        lidar=lidar,
        odometry_rate=values["odometry_rate"],
        imu_rate=values["imu_rate"],
        scan_rate=values["scan_rate"],
    )


def _names(written: Sequence[str] | str | None) -> list[str]:
    """The names in a list, whose texts may hold several with commas between them."""
    texts = [written] if isinstance(written, str) else written or []
    return [name.strip() for text in texts for name in text.split(",") if name.strip()]


def _robots(names: Sequence[str]) -> tuple[str, ...]:
    if not names:
        raise SettingsError("parameter 'robots' names no robot")
    for name in names:
        if not ROBOT_NAME.fullmatch(name) or "__" in name:
            raise SettingsError(f"parameter 'robots': '{name}' cannot be a namespace")
        if names.count(name) > 1:
            raise SettingsError(f"parameter 'robots': '{name}' stands there twice")
        if name in BY_NAME:
            raise SettingsError(f"parameter 'robots': '{name}' is the name of a parameter")
    return tuple(names)


def _poses(numbers: Sequence[float]) -> tuple[Pose, ...]:
    if len(numbers) % NUMBERS_PER_POSE:
        raise SettingsError(f"parameter 'start_poses': {len(numbers)} numbers are no triples of x, y, yaw")
    return tuple(
        Pose(*numbers[at : at + NUMBERS_PER_POSE]) for at in range(0, len(numbers), NUMBERS_PER_POSE)
    )
