"""Which robots a graph shows: a robot is a namespace in which somebody estimates odometry or drives.

There is no list of robots to keep. What tells of a robot are names: that of the topic on which its filter publishes,
and that of its controller's node.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

ROOT = "/"


@dataclass(frozen=True, slots=True)
class Presence:
    """What of one robot is in the graph. `controllers` are the ids of those who publish its mode."""

    filtered: bool = False
    driven: bool = False
    controllers: frozenset[str] = frozenset()


def robot_of_topic(topic: str, ending: str) -> str | None:
    """Return the robot whose topic this is, None where it ends otherwise; `/` is a robot without a namespace."""
    tail = "/" + ending.strip("/")
    return robot_of_namespace(topic[: -len(tail)]) if topic.endswith(tail) else None


def robot_of_namespace(namespace: str) -> str:
    """Return the name of the robot in a namespace: `robot1` for `/robot1`."""
    return namespace.strip("/") or ROOT


def inside(robot: str, name: str) -> str:
    """Return the full name of what is called `name` in the namespace of a robot."""
    return f"/{name}" if robot == ROOT else f"/{robot}/{name}"


def robots(
    published: Iterable[str], nodes: Iterable[tuple[str, str]], ending: str, controller: str
) -> dict[str, Presence]:
    """Return the robots by name, from the topics that have publishers and from the nodes (name, namespace)."""
    filtered = {robot for topic in published if (robot := robot_of_topic(topic, ending)) is not None}
    driven = {robot_of_namespace(namespace) for name, namespace in nodes if name == controller}
    return {robot: Presence(robot in filtered, robot in driven) for robot in sorted(filtered | driven)}


def part_of_status(name: str, hardware: str, robots: Iterable[str]) -> tuple[str, str] | None:
    """Return the robot that a status of diagnostics is about, and which part of it; None where it names none.

    It names one as its hardware, or in front of its name.
    """
    words = name.strip("/")
    for robot in robots:
        if words.startswith(f"{robot}/"):
            return robot, words[len(robot) + 1 :]
        if hardware.strip("/") == robot:
            return robot, words
    return None
