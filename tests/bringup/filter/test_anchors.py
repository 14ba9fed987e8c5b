"""Situations from robot_localization's own tests, with its tolerances."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from bringup.filter.estimator import Estimator
from bringup.filter.localization import Estimate, Localization
from bringup.filter.measurement import Measurement
from bringup.filter.settings import NANOSECONDS, NEVER_REJECT, Settings
from bringup.filter.state import ACCELERATION, LINEAR, ORIENTATION, POSE, VX, X, Y, Z

Make = Callable[..., Any]
FilterOf = Callable[..., Localization]
Feed = Callable[..., int]


def _estimate(localization: Localization) -> Estimate:
    estimate = localization.estimate()
    assert estimate is not None
    return estimate


def test_first_measurement_is_taken_over_and_the_second_believed(
    settings_of: Callable[..., Settings],
) -> None:
    estimator = Estimator(settings_of().estimation)
    every = np.arange(15, dtype=np.intp)
    noise = np.eye(15) * 1e-9
    values = np.array([0.15 * index for index in range(15)])
    estimator.process(Measurement(1000, "all", every, tuple(values), noise, NEVER_REJECT))
    assert (estimator.state == values).all()
    assert (estimator.covariance == noise).all()
    estimator.covariance = np.eye(15) * 0.5
    estimator.process(Measurement(1002, "all", every, tuple(2 * values), noise, NEVER_REJECT))
    difference = estimator.state - 2 * values
    difference[ORIENTATION] = np.mod(difference[ORIENTATION] + math.pi, 2 * math.pi) - math.pi
    assert np.abs(difference).max() < 0.001


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_velocity_becomes_a_way(
    filter_of: FilterOf, config: Make, twist: Make, feed: Feed, axis: int
) -> None:
    """Five metres a second for 400 messages at 20 Hz."""
    localization = filter_of(
        twist0="twist", twist0_config=config("vx", "vy", "vz", "vroll", "vpitch", "vyaw")
    )
    values = [0.0] * 6
    values[axis] = 5.0
    feed(localization, "twist0", lambda stamp: twist(stamp, values), rate=20.0, count=400)
    state = _estimate(localization).state
    assert abs(state[VX + axis] - 5.0) < 0.1
    assert abs(state[axis] - 100.0) < 2.0


def test_a_quarter_circle_ends_as_far_ahead_as_aside(
    filter_of: FilterOf, config: Make, twist: Make, feed: Feed
) -> None:
    localization = filter_of(
        twist0="twist", twist0_config=config("vx", "vy", "vz", "vroll", "vpitch", "vyaw")
    )
    values = (1.0, 0.0, 0.0, 0.0, 0.0, math.pi / 10)
    feed(localization, "twist0", lambda stamp: twist(stamp, values), rate=20.0, count=100)
    state = _estimate(localization).state
    assert abs(state[X] - state[Y]) < 0.5


def test_angular_velocities_are_those_of_the_body(
    filter_of: FilterOf, config: Make, twist: Make, feed: Feed
) -> None:
    """Rolled onto its right side, the robot that pitches up turns about the vertical, and drives off that way."""
    localization = filter_of(
        twist0="twist", twist0_config=config("vx", "vy", "vz", "vroll", "vpitch", "vyaw")
    )
    quarter = math.pi / 10
    start = NANOSECONDS
    for values in ((0, 0, 0, -quarter, 0, 0), (0, 0, 0, 0, quarter, 0), (3.0, 0, 0, 0, 0, 0)):
        start = feed(
            localization, "twist0", lambda s, v=values: twist(s, v), rate=20.0, count=100, start=start
        )
    assert abs(_estimate(localization).state[Y] + 15.0) < 1.0


def test_only_the_configured_axes_of_a_pose_are_fused(
    filter_of: FilterOf, config: Make, pose: Make, feed: Feed
) -> None:
    localization = filter_of(pose0="pose", pose0_config=config("x", "z"))
    values = (20.0, 10.0, -40.0, 0.0, 0.0, 0.0)
    feed(localization, "pose0", lambda stamp: pose(stamp, values), rate=50.0, count=50)
    state = _estimate(localization).state
    assert state[[X, Z]] == pytest.approx([20.0, -40.0], abs=0.1)
    assert abs(state[Y]) < 0.01


def test_odometry_of_large_variance_is_still_believed_where_nothing_else_is(
    filter_of: FilterOf, config: Make, odometry: Make, feed: Feed
) -> None:
    localization = filter_of(odom0="odom", odom0_config=config("x", "z"))
    values = (20.0, 10.0, -40.0, 0.0, 0.0, 0.0)
    feed(localization, "odom0", lambda stamp: odometry(stamp, pose=values, variance=2.0), rate=50.0, count=50)
    state = _estimate(localization).state
    assert state[[X, Z]] == pytest.approx([20.0, -40.0], abs=0.01)
    assert abs(state[Y]) < 0.01


def test_an_imu_gives_the_attitude(filter_of: FilterOf, config: Make, imu: Make, feed: Feed) -> None:
    localization = filter_of(imu0="imu", imu0_config=config("roll", "pitch", "yaw"))
    rpy = (math.pi / 4, -math.pi / 4, math.pi / 2)
    feed(localization, "imu0", lambda stamp: imu(stamp, rpy=rpy), rate=50.0, count=50)
    assert _estimate(localization).state[ORIENTATION] == pytest.approx(rpy, abs=0.1)


def test_an_imu_without_orientation_says_nothing_about_it(
    filter_of: FilterOf, config: Make, imu: Make, feed: Feed
) -> None:
    localization = filter_of(imu0="imu", imu0_config=config("roll", "pitch", "yaw"))
    feed(localization, "imu0", lambda stamp: imu(stamp, omega=(1.0, 0.0, 0.0)), rate=50.0, count=50)
    assert localization.estimate() is None


def test_accelerations_are_integrated_twice(filter_of: FilterOf, config: Make, imu: Make, feed: Feed) -> None:
    """One second of acceleration, one of none; gravity is not taken off."""
    localization = filter_of(imu0="imu", imu0_config=config("ax", "ay", "az"))
    start = NANOSECONDS
    for force in ((1.0, -1.0, 1.0), (0.0, 0.0, 0.0)):
        start = feed(
            localization, "imu0", lambda s, f=force: imu(s, force=f), rate=50.0, count=50, start=start
        )
    state = _estimate(localization).state
    assert state[LINEAR] == pytest.approx([1.0, -1.0, 1.0], abs=0.4)
    assert state[POSE][:3] == pytest.approx([1.8, -1.8, 1.8], abs=0.6)
    assert state[ACCELERATION] == pytest.approx([0.0, 0.0, 0.0], abs=0.1)
