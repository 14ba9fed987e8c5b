"""Where wandering goes: free places, least visited, kept until they are reached or blocked."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from bringup.control.command import Command, Pose
from bringup.control.settings import Settings
from bringup.control.wander import CELL, GOAL_LIFE, Goal, Memory, wandered

SETTINGS = Settings(mode="wander")
ORIGIN = Pose(0.0, 0.0, 0.0)
NOTHING: NDArray[np.float64] = np.empty((0, 2))


def ring(far: float, gap: tuple[float, float] = (0.0, 0.0)) -> NDArray[np.float64]:
    """Points all round at one distance, but for bearings inside `gap`."""
    bearings = np.linspace(-math.pi, math.pi, 180, endpoint=False)
    bearings = bearings[(bearings <= gap[0]) | (bearings >= gap[1])]
    return far * np.column_stack((np.cos(bearings), np.sin(bearings)))


def goal(memory: Memory) -> Goal:
    assert memory.goal is not None
    return memory.goal


def test_the_goal_lies_in_the_only_gap() -> None:
    memory, command = wandered(Memory(), ORIGIN, ring(0.7, gap=(1.0, 2.2)), SETTINGS, now=0.0)
    assert 1.3 < ORIGIN.bearing(goal(memory).x, goal(memory).y) < 1.9
    assert command.linear == 0.0
    assert command.angular > 0.0


def test_walled_in_it_stands_still_until_there_is_a_way() -> None:
    memory, command = wandered(Memory(), ORIGIN, ring(0.6), SETTINGS, now=0.0)
    assert memory.goal is None
    assert command == Command(0.0, 0.0)
    memory, _ = wandered(memory, ORIGIN, NOTHING, SETTINGS, now=0.1)
    assert memory.goal is not None


def test_of_places_equally_free_it_prefers_those_it_has_not_been_to() -> None:
    worn = {(column, row): 5 for column in range(-20, 20) for row in range(20)}
    for seed in range(20):
        settings = replace(SETTINGS, seed=seed)
        memory, _ = wandered(Memory(visits=worn), Pose(0, -0.01, 0), NOTHING, settings, now=0.0)
        assert goal(memory).y < 0.0


@pytest.mark.parametrize(
    ("name", "pose", "points", "now", "kept"),
    [
        ("on the way", Pose(0.5, 0.0, 0.0), NOTHING, 1.0, True),
        ("reached", Pose(1.9, 0.0, 0.0), NOTHING, 1.0, False),
        ("too old", ORIGIN, NOTHING, GOAL_LIFE + 0.1, False),
        ("clock set back", ORIGIN, NOTHING, -1.0, False),
        ("something in the way", ORIGIN, np.array([[0.6, 0.1]]), 1.0, False),
        ("something beside the way", ORIGIN, np.array([[0.6, 0.6]]), 1.0, True),
    ],
)
def test_a_goal_is_kept_until(
    name: str, pose: Pose, points: NDArray[np.float64], now: float, kept: bool
) -> None:
    set_out = Memory(goal=Goal(2.0, 0.0, since=0.0))
    memory, _ = wandered(set_out, pose, points, SETTINGS, now)
    assert (memory.goal == set_out.goal) == kept, name


def test_it_turns_on_the_spot_towards_what_is_aside_and_drives_towards_what_is_ahead() -> None:
    for bearing, drives in ((0.0, True), (0.3, True), (1.0, False), (-2.5, False)):
        place = Goal(2 * math.cos(bearing), 2 * math.sin(bearing), since=0.0)
        _, command = wandered(Memory(goal=place), ORIGIN, NOTHING, SETTINGS, now=0.1)
        assert (command.linear > 0.0) == drives
        assert command.angular * bearing >= 0.0
        assert abs(command.angular) <= SETTINGS.max_angular_vel
        assert command.linear <= SETTINGS.max_linear_vel


def test_it_backs_straight_out_of_what_is_inside_its_circle() -> None:
    for x, sign in ((0.2, -1.0), (-0.2, 1.0)):
        memory, command = wandered(Memory(), ORIGIN, np.array([[x, 0.0]]), SETTINGS, now=0.0)
        assert math.copysign(1.0, command.linear) == sign
        assert command.angular == 0.0
        assert memory.goal is None


def test_a_cell_counts_each_time_it_is_entered() -> None:
    memory = Memory()
    for x in (0.1, 0.2, CELL + 0.1, 0.1):
        memory, _ = wandered(memory, Pose(x, 0.1, 0.0), NOTHING, SETTINGS, now=0.0)
    assert memory.visits == {(0, 0): 2, (1, 0): 1}


def test_one_seed_makes_one_choice_and_seeds_differ() -> None:
    def choice(seed: int) -> Goal:
        return goal(wandered(Memory(), ORIGIN, NOTHING, replace(SETTINGS, seed=seed), now=0.0)[0])

    assert choice(3) == choice(3)
    assert len({choice(seed) for seed in range(10)}) > 5
