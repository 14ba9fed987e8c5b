"""Stopping before obstacles: bounds that hold for any points, and cases that tell what they mean."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from bringup.control.clearance import own_half
from bringup.control.command import STANDSTILL, Command
from bringup.control.guard import BODY, CREEP, LAG, SPARE, guarded
from bringup.control.ramp import ramped, stoppable_speed, stopping_distance
from bringup.control.settings import Settings

Array = NDArray[np.float64]
SETTINGS = Settings()

speeds = st.floats(-0.8, 0.8)
turns = st.floats(-1.5, 1.5)
settings = st.builds(
    Settings,
    max_linear_deceleration=st.floats(0.3, 2.0),
    obstacle_distance=st.floats(0.3, 2.0),
    robot_radius=st.floats(0.1, 0.29),
    side_clearance=st.floats(0.02, 0.5),
)


@st.composite
def points(draw: st.DrawFn, least: float = 0.3) -> Array:
    polar = draw(st.lists(st.tuples(st.floats(least, 6.0), st.floats(-math.pi, math.pi)), max_size=30))
    return np.array([(far * math.cos(at), far * math.sin(at)) for far, at in polar]).reshape(-1, 2)


def at(*places: tuple[float, float]) -> Array:
    return np.array(places, dtype=float).reshape(-1, 2)


@given(seen=points(), given_settings=settings, speed=speeds, age=st.floats(0, 0.5), blocked=st.booleans())
def test_the_robot_stands_before_it_touches_anything(
    seen: Array, given_settings: Settings, speed: float, age: float, blocked: bool
) -> None:
    command = guarded(Command(speed, 0.0), seen, given_settings, age=age, blocked=blocked).command
    way = stopping_distance(abs(command.linear), given_settings.max_linear_deceleration, age + LAG)
    for share in np.linspace(0.0, 1.0, 12):
        left = seen - np.array([math.copysign(share * way, speed), 0.0])
        assert not len(left) or np.hypot(*left.T).min() >= given_settings.robot_radius - 1e-9


@given(seen=points(0.1), given_settings=settings, speed=speeds, turn=turns, blocked=st.booleans())
def test_a_guarded_velocity_is_never_more_than_the_wanted_one_nor_against_it(
    seen: Array, given_settings: Settings, speed: float, turn: float, blocked: bool
) -> None:
    command = guarded(Command(speed, turn), seen, given_settings, age=0.1, blocked=blocked).command
    assert abs(command.linear) <= abs(speed)
    assert command.linear * speed >= 0.0
    assert command.angular in (turn, 0.0)


@given(
    before=st.builds(Command, speeds, turns), wanted=st.builds(Command, speeds, turns), dt=st.floats(0, 0.2)
)
def test_velocities_change_no_faster_than_allowed_and_end_at_the_wanted_one(
    before: Command, wanted: Command, dt: float
) -> None:
    after = ramped(before, wanted, SETTINGS, dt)
    assert abs(after.linear - before.linear) <= SETTINGS.max_linear_deceleration * dt + 1e-12
    assert abs(after.angular - before.angular) <= SETTINGS.max_angular_acceleration * dt + 1e-12
    assert (
        min(before.linear, wanted.linear) - 1e-12 <= after.linear <= max(before.linear, wanted.linear) + 1e-12
    )
    for _ in range(30):
        after = ramped(after, wanted, SETTINGS, 0.1)
    assert (after.linear, after.angular) == pytest.approx((wanted.linear, wanted.angular))


@given(distance=st.floats(0, 20), deceleration=st.floats(0.3, 2), reaction=st.floats(0, 1))
def test_the_stoppable_speed_needs_just_the_distance(
    distance: float, deceleration: float, reaction: float
) -> None:
    speed = stoppable_speed(distance, deceleration, reaction)
    assert stopping_distance(speed, deceleration, reaction) == pytest.approx(distance, abs=1e-9)
    assert stoppable_speed(-distance, deceleration, reaction) == 0.0


@given(far=st.floats(0.6, 6.0), speed=st.floats(0, 0.8))
def test_of_two_robots_face_to_face_each_keeps_to_its_half(far: float, speed: float) -> None:
    """`far` is the distance between the middles; each sees at most the other's hull."""
    command = guarded(Command(speed, 0.0), at((far - BODY, 0.0)), SETTINGS, age=0.1, blocked=False).command
    way = stopping_distance(command.linear, SETTINGS.max_linear_deceleration, 0.1 + LAG)
    if command.linear > CREEP:
        assert way <= far / 2 - SETTINGS.robot_radius - SPARE + 1e-9
    assert 2 * way <= far - 2 * SETTINGS.robot_radius


@pytest.mark.parametrize(
    ("name", "seen", "wanted", "moves"),
    [
        ("nothing in sight", at(), Command(0.5, 0.0), True),
        ("ahead, nearer than obstacle_distance", at((0.49, 0.0)), Command(0.5, 0.0), False),
        ("ahead, far", at((3.0, 0.0)), Command(0.5, 0.0), True),
        ("ahead to the side, in the swept strip", at((0.3, 0.3)), Command(0.5, 0.0), False),
        ("beside", at((0.0, 0.4)), Command(0.5, 0.0), True),
        ("behind while going ahead", at((-0.4, 0.0)), Command(0.5, 0.0), True),
        ("behind while going back", at((-0.4, 0.0)), Command(-0.5, 0.0), False),
        ("ahead while going back", at((0.4, 0.0)), Command(-0.5, 0.0), True),
        ("walls on both sides of a passage", at(*((x / 10, y) for x in range(-20, 21) for y in (-0.6, 0.6))),
         Command(0.5, 0.0), True),
    ],
)  # fmt: skip
def test_obstacles_count_in_the_direction_of_motion(
    name: str, seen: Array, wanted: Command, moves: bool
) -> None:
    command = guarded(wanted, seen, SETTINGS, age=0.05, blocked=False).command
    assert (command.linear != 0.0) == moves, name


def test_a_post_beside_the_way_slows_a_curve_towards_it_and_no_other() -> None:
    def speed(turn: float) -> float:
        settings = Settings(obstacle_distance=0.9)
        post = at((0.8, 0.5))
        return guarded(Command(0.5, turn), post, settings, age=0.05, blocked=False).command.linear

    assert speed(1.5) < speed(0.0)
    assert speed(-1.5) == speed(0.0)


@pytest.mark.parametrize(("distance", "turns"), [(0.24, False), (0.26, True)])
def test_the_robot_does_not_turn_with_something_inside_its_circle(distance: float, turns: bool) -> None:
    command = guarded(Command(0.0, 1.0), at((0.0, distance)), SETTINGS, age=0.0, blocked=False).command
    assert (command.angular != 0.0) == turns


def test_a_stopped_robot_drives_on_only_when_the_way_is_clear_by_the_hysteresis() -> None:
    blocked, seen = False, []
    for ahead in (0.65, 0.55, 0.49, 0.51, 0.59, 0.61, 0.55, 0.49):
        answer = guarded(Command(0.5, 0.0), at((ahead, 0.0)), SETTINGS, age=0.0, blocked=blocked)
        assert (answer.command.linear == 0.0) == answer.blocked
        blocked = answer.blocked
        seen.append(blocked)
    assert seen == [False, False, True, True, True, False, False, True]


def test_a_wall_beside_the_robot_hardly_limits_its_half_and_one_ahead_does() -> None:
    beside = at(*((x / 20, 0.6) for x in range(-40, 41)))
    ahead = at(*((0.6, y / 20) for y in range(-40, 41)))
    assert own_half(beside, 1.0, SETTINGS.robot_radius, BODY) > 0.15
    assert own_half(ahead, 1.0, SETTINGS.robot_radius, BODY) == pytest.approx(0.125)
    assert own_half(ahead, -1.0, SETTINGS.robot_radius, BODY) == math.inf


def test_nothing_moves_a_robot_that_is_to_stand() -> None:
    assert guarded(STANDSTILL, at((1.0, 0.0)), SETTINGS, age=0.0, blocked=False).command == STANDSTILL
