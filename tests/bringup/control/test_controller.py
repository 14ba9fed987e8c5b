"""One tick: what each mode wants, and what makes the robot stand."""

import math
from dataclasses import replace

import numpy as np
import pytest

from bringup.control.command import Command, Pose
from bringup.control.controller import Odometry, Sight, State, ticked
from bringup.control.journey import Goal, Journey
from bringup.control.outcome import Outcome
from bringup.control.settings import Settings

HERE = Pose(0.0, 0.0, 0.0)
FREE = Sight(10.0, np.empty((0, 2)), HERE)
HEARD = Odometry(10.0, HERE)
DRIVING = State(command=Command(0.5, 0.0), at=9.95)


def settled(settings: Settings, sight: Sight, odometry: Odometry | None = HEARD) -> Command:
    """The command after so many ticks that no ramp is left; nothing moves or ages meanwhile."""
    state = State(at=10.0)
    for _ in range(40):
        state = replace(ticked(state, settings, 10.1, sight, odometry), at=10.0)
    return state.command


@pytest.mark.parametrize(
    ("mode", "command"),
    [
        ("linear", Command(0.5, 0.0)),
        ("rotational", Command(0.0, 1.0)),
        ("hold", Command(0.0, 0.0)),
    ],
)
def test_each_mode_settles_at_its_velocity(mode: str, command: Command) -> None:
    after = settled(Settings(mode=mode), FREE)
    assert (after.linear, after.angular) == pytest.approx((command.linear, command.angular))


def test_wandering_moves() -> None:
    assert settled(Settings(mode="wander"), FREE) != Command(0.0, 0.0)


@pytest.mark.parametrize(
    ("name", "mode", "now", "sight", "odometry", "fault"),
    [
        ("all well", "linear", 10.1, FREE, HEARD, None),
        ("no scan yet", "linear", 10.1, None, HEARD, "no usable scan"),
        ("scan lost", "linear", 10.6, FREE, Odometry(10.5, HERE), "no scan for 0.5 s"),
        ("scan lost while turning", "rotational", 10.6, FREE, Odometry(10.5, HERE), "no scan for 0.5 s"),
        ("odometry lost", "linear", 10.6, replace(FREE, at=10.5), HEARD, "no odometry for 0.5 s"),
        ("odometry never needed", "linear", 10.1, FREE, None, None),
        ("no odometry to wander by", "wander", 10.1, FREE, None, "no odometry"),
        ("clock set back", "linear", 5.0, FREE, HEARD, "no scan for 0.5 s"),
    ],
)
def test_the_robot_brakes_when_it_cannot_know(
    name: str, mode: str, now: float, sight: Sight | None, odometry: Odometry | None, fault: str | None
) -> None:
    settings = Settings(mode=mode, scan_timeout=0.5, odometry_timeout=0.5)
    after = ticked(replace(DRIVING, at=now - 0.1), settings, now, sight, odometry)
    assert after.fault == fault, name
    if fault is not None:
        assert after.command.linear == pytest.approx(0.5 - 0.1 * settings.emergency_deceleration)


def test_a_late_tick_does_not_jump_the_speed() -> None:
    after = ticked(State(at=0.0), Settings(), 10.0, FREE, HEARD)
    assert 0.0 < after.command.linear <= 0.16 + 1e-9
    assert ticked(State(), Settings(), 10.0, FREE, HEARD).command.linear == 0.0


def test_points_are_carried_along_with_the_odometry() -> None:
    """What was ahead at the time of the scan is beside the robot after a quarter turn."""
    settings = Settings(obstacle_distance=0.8)
    ahead = Sight(10.0, np.array([[0.7, 0.0]]), HERE)
    assert settled(settings, ahead).linear == 0.0
    turned = Odometry(10.0, Pose(0.0, 0.0, math.pi / 2))
    assert settled(settings, ahead, turned).linear == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("name", "number", "x", "outcome"),
    [
        ("goes on", 41, 0.0, None),
        ("not counted", 0, 0.0, None),
        ("begins again where it was", 1, 0.0, Outcome.LOST),
        ("is somewhere else", 41, 2.0, Outcome.LOST),
    ],
)
def test_odometry_with_another_origin_ends_a_journey(
    name: str, number: int, x: float, outcome: Outcome | None
) -> None:
    settings = Settings(mode="go_to_goal")
    state = State(journey=Journey(Goal(3.0, 0.0), 10.0), odometry=Odometry(10.0, HERE, 40))
    after = ticked(state, settings, 10.1, FREE, Odometry(10.05, Pose(x, 0.0, 0.0), number))
    assert after.journey is not None
    result = after.journey.result
    assert (None if result is None else result.outcome) == outcome, name
