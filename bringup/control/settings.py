"""The controller's parameters: values, bounds, descriptions, and what makes a set of them acceptable."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any

from bringup.control.modes import Mode

if TYPE_CHECKING:
    from collections.abc import Iterator


@dataclass(frozen=True, slots=True)
class Setting:
    """How one parameter is described: its default, its range (both ends allowed), its meaning."""

    name: str
    default: bool | float | int | str
    description: str
    minimum: float | int | None = None
    maximum: float | int | None = None
    constraints: str = ""
    read_only: bool = False


def _number(default: float, low: float, high: float, description: str, constraints: str = "") -> Any:  # noqa: ANN401 - dataclass fields are
    metadata = {"minimum": low, "maximum": high, "description": description, "constraints": constraints}
    return field(default=default, metadata=metadata)


@dataclass(frozen=True, slots=True)
class Settings:
    """Values of all parameters at one moment; field names are parameter names."""

    mode: str = field(
        default=Mode.LINEAR.value,
        metadata={
            "description": "What the robot does: drive straight, turn on the spot, wander about, stand still, go to"
            " the goals of the action go_to_goal",
            "constraints": f"one of {', '.join(Mode)}",
        },
    )
    max_linear_vel: float = _number(0.5, 0.0, 0.8, "Greatest speed ahead in m/s")
    max_angular_vel: float = _number(1.0, 0.0, 1.5, "Greatest turning speed in rad/s")
    max_linear_acceleration: float = _number(0.8, 0.1, 2.0, "Greatest gain of speed in m/s^2")
    max_linear_deceleration: float = _number(
        1.2, 0.3, 2.0, "Greatest loss of speed in m/s^2; stopping distances are computed from it"
    )
    max_angular_acceleration: float = _number(4.0, 0.5, 6.0, "Greatest gain of turning speed in rad/s^2")
    max_angular_deceleration: float = _number(4.0, 0.5, 10.0, "Greatest loss of turning speed in rad/s^2")
    emergency_deceleration: float = _number(
        4.0, 0.3, 10.0, "Loss of speed in m/s^2 when the robot must stand because it lacks a sensor"
    )
    emergency_angular_deceleration: float = _number(
        15.0,
        0.5,
        50.0,
        "Loss of turning speed in rad/s^2 when the robot must stand because it lacks a sensor",
    )
    obstacle_distance: float = _number(
        0.5,
        0.1,
        5.0,
        "Distance in m from the middle of the axle at which the robot stands before an obstacle ahead",
        "greater than robot_radius",
    )
    obstacle_hysteresis: float = _number(
        0.1, 0.0, 1.0, "How much farther in m than obstacle_distance the way must be clear to drive on"
    )
    robot_radius: float = _number(
        0.25, 0.05, 1.0, "Radius in m of the circle about the middle of the axle that holds the whole robot"
    )
    side_clearance: float = _number(0.12, 0.02, 1.0, "Distance in m kept beside the robot while it drives")
    lidar_x: float = _number(0.0, -0.5, 0.5, "How far in m the lidar sits ahead of the middle of the axle")
    scan_timeout: float = _number(0.5, 0.15, 5.0, "Seconds of ROS time without a scan before the robot stops")
    odometry_timeout: float = _number(
        0.2, 0.05, 5.0, "Seconds of ROS time without odometry before the robot stops"
    )
    seed: int = _number(
        0, 0, 2**31 - 1, "Start of the wandering's random choices; robots differ by their name"
    )
    goal_tolerance: float = _number(
        0.1, 0.02, 1.0, "How near in m to a goal the robot must stand, where the goal does not say it"
    )
    goal_yaw_tolerance: float = _number(
        0.0,
        0.0,
        math.pi,
        "How near in rad to a goal's heading the robot must stand, where the goal does not say it",
        "0: any heading is right",
    )
    goal_timeout: float = _number(
        0.0,
        0.0,
        86400.0,
        "Seconds of ROS time in which a goal must be reached, where the goal does not say it",
        "0: no end",
    )
    progress_timeout: float = _number(
        15.0, 1.0, 600.0, "Seconds of ROS time without progress after which a goal is given up"
    )
    map_resolution: float = _number(
        0.05, 0.02, 0.2, "Side in m of the cells in which the way to a goal is planned"
    )
    claim_service: str = field(
        default="",
        metadata={
            "description": "Service that is asked for each goal whether another robot has claimed the place",
            "constraints": "name of a bringup_interfaces/srv/ClaimGoal; empty: nobody is asked",
        },
    )
    use_stamped: bool = field(
        default=False,
        metadata={"description": "Send TwistStamped instead of Twist", "read_only": True},
    )


def table() -> Iterator[Setting]:
    """Every parameter as it is declared, in the order of `Settings`."""
    for each in fields(Settings):
        if isinstance(each.default, bool | float | int | str):
            yield Setting(name=each.name, default=each.default, **each.metadata)


def objection(settings: Settings) -> str | None:
    """Why this set of values cannot be used, or None. Single ranges are checked as well as relations."""
    if settings.mode not in list(Mode):
        return f"mode is {settings.mode!r}, must be one of {', '.join(Mode)}"
    for each in table():
        value = getattr(settings, each.name)
        if each.minimum is None or each.maximum is None:
            continue
        if not each.minimum <= value <= each.maximum:
            return f"{each.name} is {value}, must lie in {each.minimum} .. {each.maximum}"
    if settings.obstacle_distance <= settings.robot_radius:
        return (
            f"obstacle_distance ({settings.obstacle_distance} m) must exceed robot_radius"
            f" ({settings.robot_radius} m)"
        )
    return None
