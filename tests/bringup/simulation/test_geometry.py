import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bringup.world.geometry import Pose, between, compose, relative, wrap, yaw_of

lengths = st.floats(-100.0, 100.0)
angles = st.floats(-20.0, 20.0)
poses = st.builds(Pose, lengths, lengths, st.floats(-3.1, 3.1))


@given(angles)
def test_wrapping_keeps_the_direction_and_stays_within_half_a_turn(angle: float) -> None:
    wrapped = wrap(angle)
    assert -math.pi < wrapped <= math.pi
    assert math.cos(wrapped) == pytest.approx(math.cos(angle), abs=1e-9)
    assert math.sin(wrapped) == pytest.approx(math.sin(angle), abs=1e-9)


def test_half_a_turn_has_one_name() -> None:
    assert wrap(-math.pi) == wrap(math.pi) == math.pi


@given(poses, poses)
def test_what_is_seen_from_a_pose_is_found_again_from_there(origin: Pose, pose: Pose) -> None:
    again = compose(origin, relative(origin, pose))
    assert again.x == pytest.approx(pose.x, abs=1e-9)
    assert again.y == pytest.approx(pose.y, abs=1e-9)
    assert wrap(again.yaw - pose.yaw) == pytest.approx(0.0, abs=1e-9)


def test_a_step_forward_goes_where_the_robot_looks() -> None:
    there = compose(Pose(1.0, 2.0, math.pi / 2), Pose(3.0, 1.0, 0.0))
    assert (there.x, there.y) == pytest.approx((0.0, 5.0))


def test_half_way_between_two_headings_is_the_short_way_round() -> None:
    half = between(Pose(0.0, 0.0, 3.0), Pose(2.0, 4.0, -3.0), 0.5)
    assert (half.x, half.y) == (1.0, 2.0)
    assert abs(half.yaw) == pytest.approx(math.pi)


@given(st.floats(-3.1, 3.1))
def test_the_heading_of_a_turn_about_the_vertical(yaw: float) -> None:
    assert yaw_of(math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)) == pytest.approx(yaw)
