"""One tick of the controller: from the newest scan and odometry to the next velocity."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from bringup.control.clearance import nearest, retreat
from bringup.control.command import STANDSTILL, Command, Pose, wrapped
from bringup.control.guard import guarded
from bringup.control.journey import Journey
from bringup.control.modes import Mode
from bringup.control.outcome import Outcome, Result
from bringup.control.ramp import braked, ramped
from bringup.control.sight import Sight, moved
from bringup.control.travelling import close_by, travelled
from bringup.control.wander import Memory, wandered

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bringup.control.settings import Settings

__all__ = ["Odometry", "Sight", "State", "ended", "ticked"]

# A tick that comes late does not allow a greater change of speed than this many seconds do.
LONGEST_TICK = 0.2
# A pose this far (m, rad) from the one before is not where the robot has driven, but another origin: the filter was
# started again or set elsewhere. The first values are for any two poses, the second per second between them.
JUMP, JUMP_RATE = Command(0.3, 0.4), Command(1.2, 2.0)
NEED_ODOMETRY = (Mode.WANDER, Mode.GO_TO_GOAL)
# After this many seconds without odometry the robot stands.
BRAKED_AFTER = 0.5


@dataclass(frozen=True, slots=True)
class Odometry:
    """Where the robot is, and when that was; `number` counts what its publisher has sent, from 1, 0 if unknown."""

    at: float
    pose: Pose
    number: int = 0


@dataclass(frozen=True, slots=True)
class State:
    """Everything the controller carries from tick to tick. `fault` says why it stands still, if it must.

    `journey` is the last one, its result in it once it is over. What was seen up to `jumped` was seen from a pose
    that means nothing any more.
    """

    command: Command = STANDSTILL
    at: float | None = None
    blocked: bool = False
    memory: Memory = field(default_factory=Memory)
    fault: str | None = None
    journey: Journey | None = None
    odometry: Odometry | None = None
    jumped: float | None = None


def ticked(
    state: State, settings: Settings, now: float, sight: Sight | None, odometry: Odometry | None
) -> State:
    """The state after a tick at time `now`; its `command` is what to send."""
    elapsed = 0.0 if state.at is None else min(max(now - state.at, 0.0), LONGEST_TICK)
    state = _located(_told(state, settings), now, odometry)
    fault = _fault(settings, now, sight, odometry)
    if sight is None or fault is not None:
        command = braked(state.command, settings, elapsed)
        state = _lost(state, settings, now, fault or "no usable scan")
        return replace(state, command=command, at=now, blocked=False, fault=fault)
    pose = None if odometry is None else odometry.pose
    if state.jumped is not None and sight.at <= state.jumped:
        sight = replace(sight, pose=None)
    points = _seen(sight, pose)
    state, wanted = _wanted(state, settings, pose, sight, points, now)
    limits = close_by(settings) if settings.mode == Mode.GO_TO_GOAL else settings
    safe = guarded(wanted, points, limits, age=max(now - sight.at, 0.0), blocked=state.blocked)
    command = ramped(state.command, safe.command, settings, elapsed)
    return replace(state, command=command, at=now, blocked=safe.blocked, fault=None)


def ended(state: State, outcome: Outcome, text: str) -> State:
    """The state after its journey has ended for a reason from outside; as it is if none is under way."""
    if state.journey is None or state.journey.result is not None:
        return state
    return replace(state, journey=replace(state.journey, result=Result(outcome, text)))


def _told(state: State, settings: Settings) -> State:
    """The state after the mode: another one than going to a goal ends a journey."""
    if settings.mode == Mode.GO_TO_GOAL:
        return state
    return ended(state, Outcome.OVERRULED, f"the mode was changed to {settings.mode}")


def _located(state: State, now: float, odometry: Odometry | None) -> State:
    """The state after the newest odometry: when it jumps, places remembered in its frame mean nothing any more."""
    last = state.odometry
    state = replace(state, odometry=odometry)
    if last is None or odometry is None:
        return state
    if 0 < odometry.number < last.number:
        why = "the odometry has begun again: its frame may have another origin now"
    elif _jumps(last, odometry):
        why = "the odometry has jumped: its frame has another origin now"
    else:
        return state
    state = ended(state, Outcome.LOST, why)
    return replace(state, memory=Memory(), jumped=now)


def _jumps(last: Odometry, odometry: Odometry) -> bool:
    apart = odometry.pose.distance(last.pose.x, last.pose.y)
    turn = abs(wrapped(odometry.pose.yaw - last.pose.yaw))
    time = min(abs(odometry.at - last.at), BRAKED_AFTER)
    return apart > JUMP.linear + JUMP_RATE.linear * time or turn > JUMP.angular + JUMP_RATE.angular * time


def _lost(state: State, settings: Settings, now: float, fault: str) -> State:
    """The state after a tick without knowing what is around: a journey does not wait for ever."""
    journey = state.journey
    if journey is None or journey.result is not None:
        return state
    since = journey.lost_since
    if since is not None and now - since > settings.progress_timeout:
        return ended(state, Outcome.LOST, fault)
    return replace(state, journey=replace(journey, lost_since=now if since is None else min(since, now)))


def _seen(sight: Sight, pose: Pose | None) -> NDArray[np.float64]:
    """The scan's points as they are from where the robot is now, as far as that is known."""
    if sight.pose is None or pose is None:
        return sight.points
    return moved(sight.points, sight.pose, pose)


def _wanted(
    state: State, settings: Settings, pose: Pose | None, sight: Sight, points: NDArray[np.float64], now: float
) -> tuple[State, Command]:
    match Mode(settings.mode):
        case Mode.LINEAR:
            return state, Command(settings.max_linear_vel, 0.0)
        case Mode.ROTATIONAL:
            return state, Command(0.0, settings.max_angular_vel)
        case Mode.WANDER if pose is not None:
            memory, command = wandered(state.memory, pose, points, settings, now)
            return replace(state, memory=memory), command
        case Mode.GO_TO_GOAL if pose is not None:
            return _on_the_way(state, settings, pose, sight, points, now)
        case _:
            return state, STANDSTILL


def _on_the_way(
    state: State, settings: Settings, pose: Pose, sight: Sight, points: NDArray[np.float64], now: float
) -> tuple[State, Command]:
    if state.journey is None or state.journey.result is not None:
        return state, STANDSTILL
    journey, command = travelled(state.journey, pose, sight, settings, now, state.command)
    moves = command != STANDSTILL
    if moves and nearest(points) < settings.robot_radius:
        command = retreat(points)
    return replace(state, journey=journey), command


def _fault(settings: Settings, now: float, sight: Sight | None, odometry: Odometry | None) -> str | None:
    """Why the robot must stand, or None.

    Only wandering and going to a goal need odometry from the start; odometry that came once and stays away stops
    every mode, for then something is broken. A time before that of the message is a clock that was set back.
    """
    if sight is None:
        return "no usable scan"
    if not 0.0 <= now - sight.at <= settings.scan_timeout:
        return f"no scan for {settings.scan_timeout} s"
    if odometry is None:
        return "no odometry" if settings.mode in NEED_ODOMETRY else None
    if not 0.0 <= now - odometry.at <= settings.odometry_timeout:
        return f"no odometry for {settings.odometry_timeout} s"
    return None
