"""The odometry errs as it is told to, and its covariances say by how much."""

import math

import numpy as np
import pytest

from bringup.world.body import WHEEL_RADIUS, WHEEL_SEPARATION
from bringup.world.drive import Twist, wheel_speeds
from bringup.world.geometry import wrap
from bringup.world.odometry import Estimate, Odometry, WheelErrors

DT = 0.02
EXACT = WheelErrors(left_scale=1.0, right_scale=1.0, slip=0.0, noise=0.0)


def reckon(errors: WheelErrors, legs: list[tuple[float, Twist]], seed: int = 0) -> Estimate:
    """The estimate after legs of (seconds, motion) on wheels that roll perfectly."""
    odometry = Odometry(errors, DT, np.random.default_rng(seed))
    left = right = 0.0
    for seconds, twist in legs:
        speeds = wheel_speeds(twist)
        for _ in range(round(seconds / DT)):
            left, right = left + speeds[0] * DT, right + speeds[1] * DT
            estimate = odometry.update((left, right))
    return estimate


def test_perfect_wheels_reckon_a_circle_exactly() -> None:
    estimate = reckon(EXACT, [(4.0, Twist(0.5, math.pi / 4))])
    radius = 0.5 / (math.pi / 4)
    assert estimate.pose.x == pytest.approx(0.0, abs=1e-9)
    assert estimate.pose.y == pytest.approx(2 * radius, abs=1e-9)
    assert abs(estimate.pose.yaw) == pytest.approx(math.pi)
    assert estimate.twist.linear == pytest.approx(0.5)
    assert estimate.twist.angular == pytest.approx(math.pi / 4)


def test_a_wheel_believed_too_large_bends_the_way_as_much_as_it_should() -> None:
    estimate = reckon(WheelErrors(1.01, 1.0, 0.0, 0.0), [(10.0, Twist(0.4, 0.0))])
    assert estimate.pose.yaw == pytest.approx(-0.01 * 4.0 / WHEEL_SEPARATION)
    assert estimate.twist.linear == pytest.approx(0.4 * 1.005)


LEGS = [
    pytest.param([(15.0, Twist(0.4, 0.0))], id="straight"),
    pytest.param([(5.0, Twist(0.4, 0.0)), (2.0, Twist(0.0, 0.8)), (5.0, Twist(0.4, -0.2))], id="turning"),
]


@pytest.mark.parametrize("legs", LEGS)
@pytest.mark.parametrize(
    "errors",
    [WheelErrors(1.0, 1.0, 0.0, 0.005), WheelErrors(1.0, 1.0, 0.02, 0.0), WheelErrors(1.0, 1.0, 0.01, 0.002)],
    ids=["noise", "slip", "both"],
)
def test_random_errors_are_as_large_as_the_covariance_says(
    errors: WheelErrors, legs: list[tuple[float, Twist]]
) -> None:
    """Over many runs the mean square of each error is the variance that was told."""
    exact = reckon(EXACT, legs).pose
    runs = [reckon(errors, legs, seed) for seed in range(40)]
    told = np.diag(np.mean([run.pose_covariance for run in runs], axis=0))
    offs = np.array(
        [(run.pose.x - exact.x, run.pose.y - exact.y, wrap(run.pose.yaw - exact.yaw)) for run in runs]
    )
    found = np.mean(offs**2, axis=0)
    # 40 runs know a variance to about a quarter; three times that is a factor of two.
    assert (found < 2.0 * told).all()
    assert (found > 0.4 * told).all()


@pytest.mark.parametrize("legs", LEGS)
def test_a_wrong_radius_is_told_as_the_error_it_makes(legs: list[tuple[float, Twist]]) -> None:
    exact = reckon(EXACT, legs).pose
    wrong = reckon(WheelErrors(1.01, 1.0, 0.0, 0.0), legs)
    told = np.sqrt(np.diag(wrong.pose_covariance))
    made = np.abs((wrong.pose.x - exact.x, wrong.pose.y - exact.y, wrap(wrong.pose.yaw - exact.yaw)))
    assert made == pytest.approx(told, rel=0.15, abs=0.01)


def test_velocities_are_as_wrong_as_their_covariance_says() -> None:
    errors = WheelErrors(1.0, 1.0, 0.01, 0.002)
    odometry = Odometry(errors, DT, np.random.default_rng(3))
    turned = 0.5 * DT / WHEEL_RADIUS
    estimates = [odometry.update((turned * step, turned * step)) for step in range(1, 4000)]
    offs = np.array([(each.twist.linear - 0.5, each.twist.angular) for each in estimates])
    told = estimates[-1].twist_covariance
    assert np.mean(offs**2, axis=0) == pytest.approx(np.diag(told), rel=0.15)


def test_a_standing_robot_is_nearly_sure_and_never_certain() -> None:
    estimate = reckon(WheelErrors(), [(1.0, Twist(0.0, 0.0))])
    assert 0.0 < estimate.twist_covariance[0, 0] < 1e-5
    assert 0.0 < estimate.pose_covariance[0, 0] < 1e-5
    assert estimate.pose.x == 0.0


def test_covariances_are_those_of_something() -> None:
    estimate = reckon(WheelErrors(), [(3.0, Twist(0.5, 0.7)), (3.0, Twist(-0.3, 0.1))])
    for covariance in (estimate.pose_covariance, estimate.twist_covariance):
        assert np.allclose(covariance, covariance.T)
        assert (np.linalg.eigvalsh(covariance) > 0.0).all()
