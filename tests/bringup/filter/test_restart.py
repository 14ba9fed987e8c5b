"""A filter that starts while its robot drives, and one that is switched on and off."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from bringup.filter.localization import Localization, UnusablePoseError
from bringup.filter.settings import NANOSECONDS
from bringup.filter.state import POSE, VX, VYAW, YAW, X, Y, Z

Make = Callable[..., Any]
FilterOf = Callable[..., Localization]
SECOND = NANOSECONDS
AWAY = (3.0, 4.0, 0.0, 0.0, 0.0, 1.0)


@pytest.fixture
def driven(filter_of: FilterOf, config: Make) -> Callable[..., Localization]:
    """A filter of velocities alone that listens to how far the wheels have come."""

    def make(**parameters: object) -> Localization:
        return filter_of(odom0="o", odom0_config=config("vx", "vyaw"), odom0_widens_start=True, **parameters)

    return make


def _drive(localization: Localization, odometry: Make, pose: tuple[float, ...], start: float = 1.0) -> None:
    """A second of odometry at 50 Hz: 0.5 m/s ahead, 0.3 rad/s to the left."""
    for number in range(50):
        stamp = round((start + number / 50) * SECOND)
        message = odometry(stamp, pose=pose, twist=(0.5, 0, 0, 0, 0, 0.3), variance=1e-3)
        localization.receive("odom0", message, stamp)
        localization.update(stamp)


def _belief(localization: Localization) -> tuple[np.ndarray, np.ndarray]:
    estimate = localization.estimate()
    assert estimate is not None
    return estimate.state, estimate.covariance


def test_velocities_are_right_within_a_second_of_the_start(driven: FilterOf, odometry: Make) -> None:
    localization = driven()
    _drive(localization, odometry, AWAY)
    state, _ = _belief(localization)
    assert state[VX] == pytest.approx(0.5, abs=0.01)
    assert state[VYAW] == pytest.approx(0.3, abs=0.01)


def test_a_start_far_from_the_origin_says_so(driven: FilterOf, odometry: Make) -> None:
    """It stands at the origin, since nothing measures its place, and the true place is within its ellipse."""
    localization = driven()
    _drive(localization, odometry, AWAY)
    state, covariance = _belief(localization)
    assert np.linalg.norm(state[[X, Y]]) < 1.0
    error = np.array(AWAY)[[X, Y, YAW]]
    within = covariance[np.ix_([X, Y, YAW], [X, Y, YAW])]
    assert error @ np.linalg.inv(within) @ error < 7.81, "95 % of three dimensions"
    assert math.sqrt(covariance[X, X]) == pytest.approx(5.0, rel=0.2)


def test_a_start_at_the_origin_is_as_certain_as_the_odometry(driven: FilterOf, odometry: Make) -> None:
    localization = driven()
    _drive(localization, odometry, (0.0,) * 6)
    _, covariance = _belief(localization)
    assert math.sqrt(covariance[X, X]) < 0.3


def test_a_pose_that_is_set_is_not_doubted(driven: FilterOf, odometry: Make, pose: Make) -> None:
    localization = driven()
    localization.set_pose(pose(SECOND - 1, AWAY, 0.01), SECOND)
    _drive(localization, odometry, AWAY)
    state, covariance = _belief(localization)
    assert state[[X, Y]] == pytest.approx([3.0, 4.0], abs=0.6)
    assert covariance[X, X] < 0.5


def test_a_reset_doubts_the_origin_again(driven: FilterOf, odometry: Make) -> None:
    localization = driven()
    _drive(localization, odometry, (0.0,) * 6)
    localization.reset()
    _drive(localization, odometry, AWAY, start=3.0)
    assert _belief(localization)[1][X, X] > 20.0


@pytest.mark.parametrize("place", [(math.nan, 0, 0, 0, 0, 0), (0, 0, 0, 0, 0, math.inf)])
def test_a_pose_that_is_no_pose_is_refused(
    driven: FilterOf, odometry: Make, pose: Make, place: tuple[float, ...]
) -> None:
    localization = driven()
    _drive(localization, odometry, (0.0,) * 6)
    before = _belief(localization)
    message = pose(2 * SECOND, (0.0,) * 6)
    message.pose.pose.position.x, message.pose.pose.orientation.z = place[0], place[5]
    with pytest.raises(UnusablePoseError, match="not finite"):
        localization.set_pose(message, 2 * SECOND)
    assert (_belief(localization)[0] == before[0]).all()


def test_a_pose_without_covariance_is_believed_to_the_smallest_variance(
    driven: FilterOf, odometry: Make, pose: Make
) -> None:
    localization = driven()
    _drive(localization, odometry, (0.0,) * 6)
    localization.set_pose(pose(2 * SECOND, AWAY, 0.0), 2 * SECOND)
    assert _belief(localization)[1].diagonal()[POSE] == pytest.approx(1e-9)


def test_switched_off_it_drops_measurements_and_stands_still(driven: FilterOf, odometry: Make) -> None:
    localization = driven()
    _drive(localization, odometry, (0.0,) * 6)
    state, covariance = _belief(localization)
    localization.processing = False
    _drive(localization, odometry, (9.0,) * 6, start=2.0)
    published = localization.estimate_to_publish()
    assert published is not None
    assert published.stamp == round(2.98 * SECOND), "its time goes on"
    assert (published.state == state).all()
    assert (published.covariance == covariance).all()


def test_switched_on_again_it_takes_in_what_is_new(driven: FilterOf, odometry: Make) -> None:
    localization = driven()
    _drive(localization, odometry, (0.0,) * 6)
    localization.processing = False
    localization.receive("odom0", odometry(2 * SECOND, twist=(9.0, 0, 0, 0, 0, 0)), 2 * SECOND)
    localization.update(2 * SECOND)
    localization.processing = True
    localization.update(2 * SECOND + 1)
    assert _belief(localization)[0][VX] == pytest.approx(0.5, abs=0.01)
    _drive(localization, odometry, (0.0,) * 6, start=2.5)
    assert _belief(localization)[0][Z] == 0.0
    assert _belief(localization)[0][X] > 0.5


def test_switched_off_before_its_first_measurement_it_has_no_estimate(
    driven: FilterOf, odometry: Make
) -> None:
    localization = driven()
    localization.processing = False
    _drive(localization, odometry, AWAY)
    assert localization.estimate() is None
