"""What is known of each robot, and how that makes it count: well, in doubt, in trouble, silent."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import IntEnum

from bringup.fleet.discovery import Presence
from bringup.fleet.frames import Place


class Health(IntEnum):
    """How a robot is; the values are those of diagnostic_msgs and of RobotSummary."""

    OK = 0
    WARN = 1
    ERROR = 2
    STALE = 3


# Diagnostics come about once a second: what was said this long ago (ns) is said by nobody any more.
_FORGOTTEN = 5_000_000_000


@dataclass(frozen=True, slots=True)
class Limits:
    """From when on odometry is too old, in seconds, and whether a robot without a controller is in doubt."""

    stale_after: float
    controlled: bool = True


@dataclass(frozen=True, slots=True)
class Motion:
    """The last odometry of a robot: when it was made (ns), where, how fast (m/s, rad/s)."""

    made: int
    place: Place
    speed: float
    turn_rate: float


@dataclass(frozen=True, slots=True)
class Complaint:
    """What diagnostics said of a part of a robot, and when (ns of a clock that never stands)."""

    level: Health
    words: str
    at: int


@dataclass(frozen=True, slots=True)
class Robot:
    """Everything that is known of one robot. `missed` is since when nothing of it is in the graph, in ns.

    `told` is the last that diagnostics said of each of its parts, by the name of the part.
    """

    name: str
    presence: Presence
    missed: int | None = None
    motion: Motion | None = None
    mode: str = ""
    contacts: int = 0
    told: Mapping[str, Complaint] = field(default_factory=dict)

    def age(self, now: int) -> float | None:
        """Return how old its odometry is in seconds; None where none has come."""
        return None if self.motion is None else max(0, now - self.motion.made) * 1e-9


@dataclass(frozen=True, slots=True)
class Turnout:
    """The robots after a look at the graph, with the names of those that have come and gone."""

    robots: dict[str, Robot]
    come: tuple[str, ...]
    gone: tuple[str, ...]


def looked(
    robots: Mapping[str, Robot], present: Mapping[str, Presence], now: int, gone_after: float
) -> Turnout:
    """Return who is there at a time (ns of a clock that never stands), after what a look at the graph has shown.

    One that is missing for `gone_after` seconds has gone: less, and a node of it may just be starting again.
    """
    after = {}
    for name in sorted(robots.keys() | present.keys()):
        robot = robots.get(name)
        if name in present:
            known = Robot(name, present[name]) if robot is None else robot
            after[name] = replace(known, presence=present[name], missed=None)
        elif robot is not None:
            missed = now if robot.missed is None else robot.missed
            if now - missed < gone_after * 1e9:
                after[name] = replace(robot, missed=missed, presence=replace(robot.presence, driven=False))
    return Turnout(
        after, tuple(sorted(after.keys() - robots.keys())), tuple(sorted(robots.keys() - after.keys()))
    )


def health(robot: Robot, now: int, steady: int, limits: Limits) -> tuple[Health, tuple[str, ...]]:
    """Return how a robot is, the worst that is known of it, with the reasons.

    `now` is ROS time, `steady` the time of a clock that never stands, both in ns.
    """
    found = [
        (each.level, f"{part}: {each.words}")
        for part, each in sorted(robot.told.items())
        if each.level and steady - each.at < _FORGOTTEN
    ]
    found += _silence(robot, now, limits)
    if robot.missed is None and limits.controlled and not robot.presence.driven:
        found.append((Health.WARN, "no controller"))
    return max((level for level, _ in found), default=Health.OK), tuple(words for _, words in found)


def _silence(robot: Robot, now: int, limits: Limits) -> list[tuple[Health, str]]:
    age = robot.age(now)
    if robot.missed is not None:
        return [(Health.STALE, "nothing of it is in the graph")]
    if age is None:
        return [(Health.STALE, "no odometry has come")]
    return [(Health.STALE, f"no odometry for {age:.1f} s")] if age > limits.stale_after else []
