"""What the diagnostics of the controller say."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bringup.control.modes import Mode
from bringup.control_node.diagnostics import ERROR, OK, WARN

if TYPE_CHECKING:
    from bringup.control.controller import Odometry, Sight, State
    from bringup.control.settings import Settings


def health(state: State, settings: Settings) -> tuple[bytes, str]:
    """The level and the state in a few words: an error where the robot must stand, a warning where it is blocked."""
    if state.fault is not None:
        return ERROR, f"standing still: {state.fault}"
    if state.blocked:
        return WARN, "blocked by an obstacle"
    journey = state.journey
    if settings.mode == Mode.GO_TO_GOAL and (journey is None or journey.result is not None):
        return OK, "waiting for a goal"
    return OK, f"driving: mode {settings.mode}"


def values(
    state: State, settings: Settings, now: float, sight: Sight | None, odometry: Odometry | None
) -> dict[str, str]:
    """What a reader may want to know besides; ages are in seconds."""
    told = {
        "mode": settings.mode,
        "linear velocity": f"{state.command.linear:.3f}",
        "angular velocity": f"{state.command.angular:.3f}",
        "age of the scan": "none" if sight is None else f"{now - sight.at:.3f}",
        "age of the odometry": "none" if odometry is None else f"{now - odometry.at:.3f}",
    }
    if state.journey is not None:
        goal, result = state.journey.goal, state.journey.result
        told["goal"] = f"{goal.x:.3f} {goal.y:.3f}"
        told["goal outcome"] = (
            "under way" if result is None else f"{result.outcome.name.lower()}: {result.text}"
        )
    return told
