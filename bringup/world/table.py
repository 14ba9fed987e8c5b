"""The parameters of the simulation in one table: from it the node declares them, with descriptors and ranges."""

from __future__ import annotations

import math
from dataclasses import dataclass

from bringup.world.layout import WORLDS

DAY = 86400.0


@dataclass(frozen=True, slots=True)
class Setting:
    """One parameter. Numbers have a range, both ends included; only changeable ones can be set while the node runs.

    An empty tuple as default stands for an array of numbers that may be left out. `each` marks what a robot can have of
    its own: as parameter `ROBOT.name`, or under its name in a file of robots.
    """

    name: str
    default: bool | int | float | str | tuple[str, ...]
    description: str
    low: float = -math.inf
    high: float = math.inf
    changeable: bool = False
    constraints: str = ""
    each: bool = False


def _each(name: str, default: float, description: str, low: float, high: float) -> Setting:
    """A setting that each robot can have of its own, and that can be changed while the node runs."""
    return Setting(name, default, description, low, high, changeable=True, each=True)


_RUN = (
    Setting("world", "arena", "Which world to make.", constraints=f"One of: {', '.join(WORLDS)}"),
    Setting("seed", 1, "Seed of the world's obstacles and of all noise.", 0, 2**31 - 1),
    Setting(
        "robots",
        ("robot1", "robot2"),
        "Names of the robots, before their topics and frames; also one text with commas.",
    ),
    Setting(
        "robots_file",
        "",
        "YAML file with the robots, their start poses and settings of their own, instead of 'robots'; empty: none.",
    ),
    Setting("start_poses", (), "x, y, yaw of each robot in turn (m, rad); empty: the world's own."),
    Setting("world_frame", "", "Frame of the world: a static transform to each robot's odom; empty: none."),
    Setting("headless", True, "Without a window."),
    Setting(
        "duration",
        0.0,
        "Simulated seconds after which the node ends by itself; 0: never.",
        0.0,
        365 * DAY,
        changeable=True,
    ),
    Setting("speed", 1.0, "Simulated over real time; 0: as fast as possible.", 0.0, 1000.0, changeable=True),
    Setting(
        "unthrottled_ticks",
        5,
        "How many ticks of 10 ms may be worked out before they are published, while none waits for real time.",
        1,
        20,
        changeable=True,
    ),
    Setting(
        "filter_lag",
        1.0,
        "With speed 0, simulated seconds that a robot's filter may be behind before the world waits; 0: never waits.",
        0.0,
        60.0,
        changeable=True,
    ),
    Setting("paused", False, "Whether simulated time stands still.", changeable=True),
    Setting("lockstep", False, "Go on only when each robot has been sent a command for the next stretch."),
    Setting("lockstep_ticks", 10, "Length of such a stretch, in ticks of 10 ms.", 1, 100),
    Setting("script", "", "CSV file with time,robot,linear,angular that drives the robots; empty: none."),
    Setting("status_period", 2.0, "Real seconds between two status lines.", 0.1, DAY, changeable=True),
    Setting(
        "picture",
        "",
        "PNG file with the driven paths, written at the end; empty: none.",
        changeable=True,
    ),
    Setting("record", "", "MP4 film of the run or PNG picture of its end, rendered offscreen; empty: none."),
    Setting("camera_rate", 0.0, "Images per second of each robot's camera; 0: none.", 0.0, 30.0),
    Setting("camera_width", 320, "Width of a camera's image in pixels.", 16, 1920),
    Setting("camera_height", 240, "Height of a camera's image in pixels.", 16, 1080),
)
_BASE = (
    _each("max_linear_velocity", 0.8, "Fastest the base drives, in m/s.", 0.01, 1.0),
    _each("max_angular_velocity", 1.5, "Fastest the base turns, in rad/s.", 0.01, 2.0),
    _each("linear_acceleration", 1.5, "Hardest the base speeds up, in m/s^2.", 0.05, 2.5),
    _each("linear_deceleration", 4.0, "Hardest the base brakes, in m/s^2.", 0.05, 4.0),
    _each("angular_acceleration", 5.0, "Hardest the base starts or stops turning, in rad/s^2.", 0.05, 10.0),
    _each("command_timeout", 0.2, "Simulated seconds after which a command is void.", 0.01, 10.0),
)
_WHEELS = (
    _each(
        "left_wheel_scale",
        1.01,
        "Left wheel's radius as the odometry believes it, over the true one.",
        0.8,
        1.25,
    ),
    _each(
        "right_wheel_scale",
        1.0,
        "Right wheel's radius as the odometry believes it, over the true one.",
        0.8,
        1.25,
    ),
    _each(
        "wheel_slip",
        0.01,
        "Standard deviation of the share of a wheel's travel that is miscounted.",
        0.0,
        0.5,
    ),
    _each("wheel_noise", 0.002, "Standard deviation of a wheel's counted travel after 1 m, in m.", 0.0, 0.5),
    Setting(
        "encoder_counts",
        0,
        "Counts of an encoder per turn of its wheel; 0: no steps.",
        0,
        2**20,
        changeable=True,
        each=True,
    ),
    _each("odometry_rate", 50.0, "Messages of odometry and ground truth per simulated second.", 1.0, 100.0),
)
_SENSORS = (
    _each("gyro_noise", 0.005, "Standard deviation of each turning rate, in rad/s.", 0.0, 1.0),
    _each("gyro_bias", 0.0002, "Error of each turning rate at the start, in rad/s.", -1.0, 1.0),
    _each("gyro_bias_walk", 0.0, "How far this error strays within 1 s, in rad/s.", 0.0, 0.1),
    _each("accelerometer_noise", 0.05, "Standard deviation of each acceleration, in m/s^2.", 0.0, 10.0),
    _each("accelerometer_bias", 0.02, "Error of each acceleration at the start, in m/s^2.", -10.0, 10.0),
    _each("accelerometer_bias_walk", 0.0, "How far this error strays within 1 s, in m/s^2.", 0.0, 1.0),
    _each("imu_rate", 100.0, "Messages of the IMU per simulated second.", 1.0, 100.0),
    _each("lidar_noise", 0.01, "Standard deviation of each range, in m.", 0.0, 1.0),
    _each("lidar_dropout", 0.0, "Share of the beams that measure nothing (NaN).", 0.0, 1.0),
    _each("lidar_range_min", 0.12, "Nearest the lidar measures, in m.", 0.0, 5.0),
    _each("lidar_range_max", 12.0, "Farthest the lidar measures, in m.", 0.1, 100.0),
    _each("scan_rate", 10.0, "Scans per simulated second.", 0.1, 50.0),
)
TABLE = (*_RUN, *_BASE, *_WHEELS, *_SENSORS)
BY_NAME = {setting.name: setting for setting in TABLE}
EACH = tuple(setting for setting in TABLE if setting.each)
