"""Drives about and sees much of the world: goes to the visible place where it has been least.

The memory counts how often each half-metre cell of the odometry frame was entered. A goal is the end of a
straight free way; it is kept until reached, blocked or too old, so the robot does not waver. A planned way, as
going to a goal has it, is not needed: the lidar sees all round, and counting visits covers a maze as well.
"""

from __future__ import annotations

import math
import random
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from bringup.control.clearance import free_travel, nearest, passing_radius, retreat
from bringup.control.command import STANDSTILL, Command, Pose

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bringup.control.settings import Settings

CELL = 0.5
HEADINGS = np.linspace(-math.pi, math.pi, 72, endpoint=False)
# Goals lie this far away, and are reached from this near.
NEAREST_GOAL, FARTHEST_GOAL = 0.4, 4.0
REACHED = 0.2
GOAL_LIFE = 20.0
# A way is planned with this much more room beside it than the guard asks for, and given up below this.
PLAN_SPARE = 0.04
GIVE_UP = 0.15
# The robot turns on the spot while its goal is farther aside than this, and turns with this gain (1/s).
ASIDE = 0.6
GAIN = 2.0


@dataclass(frozen=True, slots=True)
class Goal:
    """A place to drive to, and since when."""

    x: float
    y: float
    since: float


@dataclass(frozen=True, slots=True)
class Memory:
    """What wandering remembers: visits per cell, the cell it is in, its goal, how many it has chosen."""

    visits: Mapping[tuple[int, int], int] = field(default_factory=dict)
    cell: tuple[int, int] | None = None
    goal: Goal | None = None
    choices: int = 0


def wandered(
    memory: Memory, pose: Pose, points: NDArray[np.float64], settings: Settings, now: float
) -> tuple[Memory, Command]:
    """One tick: the memory after it and the velocity wanted, not yet guarded."""
    memory = _entered(memory, pose)
    if nearest(points) < settings.robot_radius:
        return replace(memory, goal=None), retreat(points)
    if memory.goal is None or _spent(memory.goal, pose, points, settings, now):
        memory = _chosen(memory, pose, points, settings, now)
    if memory.goal is None:
        return memory, STANDSTILL
    return memory, _towards(pose.bearing(memory.goal.x, memory.goal.y), settings)


def _towards(bearing: float, settings: Settings) -> Command:
    turn = max(-settings.max_angular_vel, min(settings.max_angular_vel, GAIN * bearing))
    return Command(settings.max_linear_vel * max(0.0, 1.0 - abs(bearing) / ASIDE), turn)


def _spent(goal: Goal, pose: Pose, points: NDArray[np.float64], settings: Settings, now: float) -> bool:
    """Whether the goal is reached, too old, or no longer at the end of a free way."""
    left = pose.distance(goal.x, goal.y)
    if left < REACHED or now - goal.since > GOAL_LIFE or now < goal.since:
        return True
    way = _free(points, np.array([pose.bearing(goal.x, goal.y)]), settings)
    return float(way[0]) < GIVE_UP


def _free(
    points: NDArray[np.float64], headings: NDArray[np.float64], settings: Settings, spare: float = 0.0
) -> NDArray[np.float64]:
    half_width = passing_radius(points, settings, spare)
    return free_travel(points, headings, half_width, max(settings.obstacle_distance, half_width))


def _chosen(
    memory: Memory, pose: Pose, points: NDArray[np.float64], settings: Settings, now: float
) -> Memory:
    """The memory with a new goal, or with none while every way is blocked."""
    free = np.minimum(_free(points, HEADINGS, settings, PLAN_SPARE), FARTHEST_GOAL)
    if not (free >= NEAREST_GOAL).any():
        free = np.minimum(_free(points, HEADINGS, settings), FARTHEST_GOAL)
    chance = random.Random(f"{settings.seed}/{memory.choices}")
    best, place = -math.inf, None
    for heading, length in zip(HEADINGS, free, strict=True):
        steps = int(length / NEAREST_GOAL)
        for step in range(1, steps + 1):
            x, y = pose.ahead(float(heading), step * NEAREST_GOAL)
            score = chance.uniform(0.0, 0.4) - _worn(memory, x, y) - 0.3 * abs(float(heading)) / math.pi
            score += 0.3 * step * NEAREST_GOAL / FARTHEST_GOAL
            if score > best:
                best, place = score, (x, y)
    goal = None if place is None else Goal(*place, since=now)
    return replace(memory, goal=goal, choices=memory.choices + 1)


def _worn(memory: Memory, x: float, y: float) -> float:
    return math.log2(1.0 + memory.visits.get(_cell(x, y), 0))


def _entered(memory: Memory, pose: Pose) -> Memory:
    cell = _cell(pose.x, pose.y)
    if cell == memory.cell:
        return memory
    return replace(memory, cell=cell, visits={**memory.visits, cell: memory.visits.get(cell, 0) + 1})


def _cell(x: float, y: float) -> tuple[int, int]:
    return math.floor(x / CELL), math.floor(y / CELL)
