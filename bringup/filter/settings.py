"""What a filter is told before it starts. Seconds, metres, radians; stamps and spans are whole nanoseconds."""

import sys
from dataclasses import dataclass
from typing import Literal, TypeAlias

from bringup.filter.state import Array

Kind: TypeAlias = Literal["odom", "pose", "twist", "imu"]
Flags: TypeAlias = tuple[bool, ...]

NEVER_REJECT = sys.float_info.max
NANOSECONDS = 1_000_000_000


@dataclass(frozen=True, slots=True)
class Part:
    """One part of a sensor's messages: its pose, its twist or its acceleration.

    `flags` are the variables to fuse, in the sensor's frame: six for a pose or a twist, three for an acceleration.
    """

    name: str
    flags: Flags
    threshold: float = NEVER_REJECT
    differential: bool = False
    relative: bool = False
    use_child_frame: bool = False


@dataclass(frozen=True, slots=True)
class Sensor:
    """One subscription, with the parts of its messages that are fused (None: not fused).

    `widens_start`: what its first message says of the pose is how wrong the origin may be as the place to start from.
    """

    name: str
    kind: Kind
    topic: str
    queue_size: int = 10
    pose: Part | None = None
    twist: Part | None = None
    acceleration: Part | None = None
    remove_gravity: bool = False
    widens_start: bool = False


@dataclass(frozen=True, slots=True)
class Frames:
    """Frame names, without leading slashes; `world` is the frame that the filter's pose is given in."""

    map: str = "map"
    odom: str = "odom"
    base_link: str = "base_link"
    base_link_output: str = "base_link"
    world: str = "odom"


@dataclass(frozen=True, slots=True, eq=False)
class Control:
    """How velocity commands are taken into account; six entries each: vx vy vz vroll vpitch vyaw."""

    axes: Flags
    timeout: int
    acceleration_limits: tuple[float, ...]
    acceleration_gains: tuple[float, ...]
    deceleration_limits: tuple[float, ...]
    deceleration_gains: tuple[float, ...]
    stamped: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Estimation:
    """What the state and its covariance start from and how they grow."""

    process_noise: Array
    initial_covariance: Array
    initial_state: Array
    dynamic_process_noise: bool = False
    two_d_mode: bool = False
    gravity: float = 9.80665


@dataclass(frozen=True, slots=True)
class Timing:
    """When the filter works."""

    frequency: float
    sensor_timeout: int
    transform_timeout: int = 0
    history_length: int = 0
    predict_to_current_time: bool = False
    smooth_lagged_data: bool = False
    reset_on_time_jump: bool = False
    disabled_at_startup: bool = False


@dataclass(frozen=True, slots=True)
class Publication:
    """What the filter tells others."""

    transform: bool = True
    transform_offset: int = 0
    acceleration: bool = False
    corrections: bool = False
    diagnostics: bool = False
    debug_file: str | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Settings:
    """Everything that the parameters say."""

    frames: Frames
    sensors: tuple[Sensor, ...]
    estimation: Estimation
    timing: Timing
    publication: Publication
    control: Control | None = None
