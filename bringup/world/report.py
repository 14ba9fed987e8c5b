"""What the simulation tells the person who watches it, as plain text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bringup.world.model import TICKS_PER_SECOND

if TYPE_CHECKING:
    from bringup.world.geometry import Pose

# An estimate older than this (in simulated seconds) is told with its age.
OLD = 1.0


def status(robot: str, pose: Pose, filter_error: str, nearest: float) -> str:
    """One robot's status line: pose in the world (m, rad), the filter against the truth, the nearest obstacle (m)."""
    return (
        f"{robot}: pose x {pose.x:z.2f} m, y {pose.y:z.2f} m, yaw {pose.yaw:z.2f} rad; "
        f"filter {filter_error}; nearest obstacle {nearest:z.2f} m"
    )


def filter_error(distance: float, turn: float, age_ticks: float) -> str:
    """The filter's error (m, rad) against the truth of the same moment."""
    age = age_ticks / TICKS_PER_SECOND
    past = f" ({age:.1f} s ago)" if age > OLD else ""
    return f"error {distance:.3f} m, {turn:.3f} rad{past}"


def behind(factor: float, speed: float, lag: float, lost: float) -> str:
    """That the run does not keep up with real time: its factor, the one that is asked for, how late it is (s)."""
    given_up = f", {lost:.1f} s given up before" if lost else ""
    return f"behind real time: factor {factor:.3f} instead of {speed:g}, {lag:.1f} s late{given_up}"


def given_up(robot: str, seconds: float) -> str:
    """That a robot's filter has said nothing for so long (real seconds)."""
    return f"the filter of {robot} has said nothing new for {seconds:g} s: the world does not wait for it any more"


def summary(simulated: float, real: float) -> str:
    """How the run went against real time, both in seconds."""
    factor = simulated / real if real > 0.0 else 0.0
    return f"simulated {simulated:z.2f} s in {real:z.2f} s: real-time factor {factor:.3f}"


def contacts(robot: str, episodes: int) -> str:
    """How often a robot has touched something."""
    return f"{robot}: {episodes} {'contact' if episodes == 1 else 'contacts'}"
