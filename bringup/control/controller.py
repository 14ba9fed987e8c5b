"""One tick of the controller: from the newest scan and odometry to the next velocity."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bringup.control.command import STANDSTILL, Command, Pose
from bringup.control.guard import guarded
from bringup.control.modes import Mode
from bringup.control.ramp import ramped
from bringup.control.sight import moved
from bringup.control.wander import Memory, wandered

if TYPE_CHECKING:
    from bringup.control.settings import Settings

# A tick that comes late does not allow a greater change of speed than this many seconds do.
LONGEST_TICK = 0.2


@dataclass(frozen=True, slots=True)
class Sight:
    """A usable scan: when it came, its points in the robot's frame, and where the robot was, if known."""

    at: float
    points: NDArray[np.float64]
    pose: Pose | None


@dataclass(frozen=True, slots=True)
class Odometry:
    """Where the robot is, and when that was heard."""

    at: float
    pose: Pose


@dataclass(frozen=True, slots=True)
class State:
    """Everything the controller carries from tick to tick. `fault` says why it stands still, if it must."""

    command: Command = STANDSTILL
    at: float | None = None
    blocked: bool = False
    memory: Memory = field(default_factory=Memory)
    fault: str | None = None


def ticked(
    state: State, settings: Settings, now: float, sight: Sight | None, odometry: Odometry | None
) -> State:
    """The state after a tick at time `now`; its `command` is what to send."""
    elapsed = 0.0 if state.at is None else min(max(now - state.at, 0.0), LONGEST_TICK)
    fault = _fault(settings, now, sight, odometry)
    if sight is None or fault is not None:
        command = ramped(state.command, STANDSTILL, settings, elapsed)
        return replace(state, command=command, at=now, blocked=False, fault=fault)
    pose = None if odometry is None else odometry.pose
    points = sight.points if pose is None or sight.pose is None else moved(sight.points, sight.pose, pose)
    memory, wanted = _wanted(state.memory, settings, pose, points, now)
    safe = guarded(wanted, points, settings, age=max(now - sight.at, 0.0), blocked=state.blocked)
    command = ramped(state.command, safe.command, settings, elapsed)
    return State(command=command, at=now, blocked=safe.blocked, memory=memory)


def _wanted(
    memory: Memory, settings: Settings, pose: Pose | None, points: NDArray[np.float64], now: float
) -> tuple[Memory, Command]:
    match Mode(settings.mode):
        case Mode.LINEAR:
            return memory, Command(settings.max_linear_vel, 0.0)
        case Mode.ROTATIONAL:
            return memory, Command(0.0, settings.max_angular_vel)
        case Mode.WANDER if pose is not None:
            return wandered(memory, pose, points, settings, now)
        case _:
            return memory, STANDSTILL


def _fault(settings: Settings, now: float, sight: Sight | None, odometry: Odometry | None) -> str | None:
    """Why the robot must stand, or None.

    Only wandering needs odometry from the start; odometry that came once and stays away stops every mode,
    for then something is broken. A time before that of the message is a clock that was set back.
    """
    if sight is None:
        return "no usable scan"
    if not 0.0 <= now - sight.at <= settings.scan_timeout:
        return f"no scan for {settings.scan_timeout} s"
    if odometry is None:
        return "no odometry" if settings.mode == Mode.WANDER else None
    if not 0.0 <= now - odometry.at <= settings.odometry_timeout:
        return f"no odometry for {settings.odometry_timeout} s"
    return None
