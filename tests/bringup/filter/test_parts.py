"""What single messages measure, seen in the estimate that the first of them makes."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from bringup.filter.localization import Localization
from bringup.filter.rotation import matrix_from_rpy, quaternion_from_rpy, rpy_from_matrix
from bringup.filter.settings import NANOSECONDS
from bringup.filter.state import (
    ACCELERATION,
    ANGULAR,
    LINEAR,
    ORIENTATION,
    POSE,
    VX,
    VY,
    VYAW,
    YAW,
    Array,
    X,
    Y,
    Z,
)
from bringup.filter.transforms import Sample

Make = Callable[..., Any]
FilterOf = Callable[..., Localization]
SECOND = NANOSECONDS
QUARTER = math.pi / 2


def _place(x: float = 0.0, y: float = 0.0, z: float = 0.0, *rpy: float) -> Sample:
    return Sample(0, (x, y, z), quaternion_from_rpy(*(rpy or (0.0, 0.0, 0.0))))


def _take(localization: Localization, sensor: str, *messages: Any) -> tuple[Array, Array]:
    for message in messages:
        localization.receive(sensor, message, 0)
        localization.update(100 * SECOND)
    estimate = localization.estimate()
    assert estimate is not None, localization.notices.take()
    return estimate.state, estimate.covariance


def test_a_pose_is_taken_into_the_world_frame(filter_of: FilterOf, config: Make, pose: Make) -> None:
    localization = filter_of(pose0="pose", pose0_config=config("x", "y", "z", "roll", "pitch", "yaw"))
    localization.frames.add_static("odom", "beacon", _place(10.0, 0.0, 1.0, 0.0, 0.0, QUARTER))
    state, _ = _take(localization, "pose0", pose(SECOND, (2.0, 0.0, 0.0, 0.0, 0.0, 0.3), frame="beacon"))
    assert state[POSE] == pytest.approx([10.0, 2.0, 1.0, 0.0, 0.0, QUARTER + 0.3])


def test_flags_and_variances_turn_with_the_frame(filter_of: FilterOf, config: Make, pose: Make) -> None:
    """The x of a frame that is turned a quarter to the left is the y of the world."""
    localization = filter_of(pose0="pose", pose0_config=config("x"))
    localization.frames.add_static("odom", "beacon", _place(0.0, 0.0, 0.0, 0.0, 0.0, QUARTER))
    message = pose(SECOND, (2.0, 3.0, 0.0, 0.0, 0.0, 0.0), frame="beacon")
    message.pose.covariance[[0, 7]] = 0.25, 9.0
    state, covariance = _take(localization, "pose0", message)
    assert state[[X, Y]] == pytest.approx([0.0, 2.0])
    assert covariance[Y, Y] == pytest.approx(0.25)
    assert covariance[X, X] == 1e-9


def test_a_pose_whose_frame_is_unknown_is_dropped_and_told(
    filter_of: FilterOf, config: Make, pose: Make
) -> None:
    localization = filter_of(pose0="pose", pose0_config=config("x"))
    localization.receive("pose0", pose(SECOND, (1.0,) * 6, frame="mars"), 0)
    localization.update(2 * SECOND)
    assert localization.estimate() is None
    assert "no transform from mars to odom" in str(localization.notices.take())


def test_relative_poses_count_from_the_first(filter_of: FilterOf, config: Make, pose: Make) -> None:
    localization = filter_of(pose0="p", pose0_config=config("x", "y", "yaw"), pose0_relative=True)
    first = pose(SECOND, (5.0, 5.0, 0.0, 0.0, 0.0, QUARTER))
    second = pose(2 * SECOND, (5.0, 7.0, 0.0, 0.0, 0.0, QUARTER + 0.1), variance=1e-12)
    state, _ = _take(localization, "pose0", first, second)
    assert state[[X, Y, YAW]] == pytest.approx([2.0, 0.0, 0.1], abs=1e-4)


def test_differential_poses_measure_the_velocity_between_two(
    filter_of: FilterOf, config: Make, pose: Make
) -> None:
    """One metre ahead and 0.2 rad to the left in half a second; the first pose says nothing."""
    localization = filter_of(pose0="p", pose0_config=config("x", "y", "yaw"), pose0_differential=True)
    localization.receive("pose0", pose(SECOND, (5.0, 5.0, 0.0, 0.0, 0.0, QUARTER), variance=0.5), 0)
    localization.update(SECOND)
    assert localization.estimate() is None
    later = pose(3 * SECOND // 2, (5.0, 6.0, 0.0, 0.0, 0.0, QUARTER + 0.2), variance=0.5)
    state, covariance = _take(localization, "pose0", later)
    assert state[[VX, VY, VYAW]] == pytest.approx([2.0, 0.0, 0.4], abs=1e-9)
    assert state[[X, Y, YAW]] == pytest.approx([0.0, 0.0, 0.0])
    assert covariance[VX, VX] == pytest.approx((0.5 + 0.5) * 0.5)


def test_two_poses_of_one_time_give_no_velocity(filter_of: FilterOf, config: Make, pose: Make) -> None:
    localization = filter_of(pose0="p", pose0_config=config("x"), pose0_differential=True)
    for x in (1.0, 2.0):
        localization.receive("pose0", pose(SECOND, (x, 0.0, 0.0, 0.0, 0.0, 0.0)), 0)
    localization.update(SECOND)
    assert localization.estimate() is None


def test_a_pose_of_another_part_of_the_robot_is_carried_to_the_base(
    filter_of: FilterOf, config: Make, odometry: Make
) -> None:
    """A camera one metre ahead of the base: its uncertain yaw makes the base uncertain sideways."""
    localization = filter_of(odom0="o", odom0_config=config("x", "y", "yaw"), odom0_pose_use_child_frame=True)
    localization.frames.add_static("base_link", "camera", _place(1.0))
    message = odometry(SECOND, pose=(4.0, 0.0, 0.0, 0.0, 0.0, 0.0), child="camera", variance=0.01)
    state, covariance = _take(localization, "odom0", message)
    assert state[[X, Y, YAW]] == pytest.approx([3.0, 0.0, 0.0])
    assert covariance[X, X] == pytest.approx(0.01)
    assert covariance[Y, Y] == pytest.approx(0.02)


def test_a_sensor_off_the_centre_moves_when_the_robot_turns(
    filter_of: FilterOf, config: Make, twist: Make, imu: Make
) -> None:
    """Turning on the spot at 1 rad/s, a sensor two metres ahead moves sideways at 2 m/s; the base does not."""
    localization = filter_of(
        twist0="t", twist0_config=config("vx", "vy"), imu0="i", imu0_config=config("vyaw")
    )
    localization.frames.add_static("base_link", "front", _place(2.0))
    _take(localization, "imu0", imu(SECOND, omega=(0.0, 0.0, 1.0)))
    state, _ = _take(localization, "twist0", twist(SECOND, (0.0, 2.0, 0.0, 0.0, 0.0, 0.0), frame="front"))
    assert state[LINEAR] == pytest.approx([0.0, 0.0, 0.0], abs=1e-6)


def test_angular_velocities_turn_with_the_imu(filter_of: FilterOf, config: Make, imu: Make) -> None:
    """An IMU that lies on its left side: its y axis looks up."""
    localization = filter_of(imu0="i", imu0_config=config("vpitch"))
    localization.frames.add_static("base_link", "imu", _place(0.0, 0.0, 0.0, QUARTER, 0.0, 0.0))
    state, _ = _take(localization, "imu0", imu(SECOND, omega=(7.0, 0.5, 7.0), frame="imu"))
    assert state[ANGULAR] == pytest.approx([0.0, 0.0, 0.5])


@pytest.mark.parametrize("mounting", [(0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, -2.5)])
def test_the_mounting_is_taken_off_an_orientation(
    filter_of: FilterOf, config: Make, imu: Make, mounting: tuple[float, float, float]
) -> None:
    base = (0.02, -0.03, 0.4)
    seen = rpy_from_matrix(matrix_from_rpy(*base) @ matrix_from_rpy(*mounting))
    localization = filter_of(imu0="i", imu0_config=config("roll", "pitch", "yaw"))
    localization.frames.add_static("base_link", "imu", _place(0.0, 0.0, 0.0, *mounting))
    state, _ = _take(localization, "imu0", imu(SECOND, rpy=seen, frame="imu"))
    assert state[ORIENTATION] == pytest.approx(base, abs=1e-3)


def test_a_relative_imu_starts_at_zero(filter_of: FilterOf, config: Make, imu: Make) -> None:
    localization = filter_of(imu0="i", imu0_config=config("yaw"), imu0_relative=True)
    first, second = imu(SECOND, rpy=(0.0, 0.0, 2.0)), imu(2 * SECOND, rpy=(0.0, 0.0, 2.2), variance=1e-12)
    state, _ = _take(localization, "imu0", first, second)
    assert state[YAW] == pytest.approx(0.2, abs=1e-4)


def test_a_differential_imu_measures_its_turning(filter_of: FilterOf, config: Make, imu: Make) -> None:
    localization = filter_of(imu0="i", imu0_config=config("yaw"), imu0_differential=True)
    first, second = imu(SECOND, rpy=(0.0, 0.0, 3.1)), imu(2 * SECOND, rpy=(0.0, 0.0, -3.1))
    localization.receive("imu0", first, 0)
    state, _ = _take(localization, "imu0", second)
    assert state[VYAW] == pytest.approx(2 * math.pi - 6.2)
    assert state[YAW] == 0.0


@pytest.mark.parametrize("mounting", [(0.0, 0.0, 0.0), (QUARTER, 0.0, -QUARTER), (0.3, -1.0, 2.0)])
@pytest.mark.parametrize("measures_attitude", [True, False])
def test_gravity_vanishes_at_rest_however_the_imu_is_mounted(
    filter_of: FilterOf,
    config: Make,
    imu: Make,
    mounting: tuple[float, float, float],
    *,
    measures_attitude: bool,
) -> None:
    """On a slope the attitude comes from the IMU's own orientation, otherwise from the (level) estimate."""
    base = (0.1, -0.2, 0.5) if measures_attitude else (0.0, 0.0, 0.0)
    attitude = matrix_from_rpy(*base) @ matrix_from_rpy(*mounting)
    force = tuple(attitude.T @ np.array((0.0, 0.0, 9.80665)))
    rpy = rpy_from_matrix(attitude) if measures_attitude else None
    localization = filter_of(
        imu0="i", imu0_config=config("ax", "ay", "az"), imu0_remove_gravitational_acceleration=True
    )
    localization.frames.add_static("base_link", "imu", _place(0.0, 0.0, 0.0, *mounting))
    state, _ = _take(localization, "imu0", imu(SECOND, rpy=rpy, force=force, frame="imu"))
    assert state[ACCELERATION] == pytest.approx([0.0, 0.0, 0.0], abs=1e-9)


def test_a_relative_imu_knows_down_from_its_mounting(filter_of: FilterOf, config: Make, imu: Make) -> None:
    """Its orientation says "not turned" on a level base, whatever way it is mounted."""
    mounting = (0.3, -1.0, 2.0)
    force = tuple(matrix_from_rpy(*mounting).T @ np.array((0.0, 0.0, 9.80665)))
    localization = filter_of(
        imu0="i",
        imu0_config=config("ax", "ay", "az"),
        imu0_relative=True,
        imu0_remove_gravitational_acceleration=True,
    )
    localization.frames.add_static("base_link", "imu", _place(0.0, 0.0, 0.0, *mounting))
    state, _ = _take(localization, "imu0", imu(SECOND, rpy=(0.0, 0.0, 0.0), force=force, frame="imu"))
    assert state[ACCELERATION] == pytest.approx([0.0, 0.0, 0.0], abs=1e-9)


def test_centripetal_acceleration_is_taken_off(filter_of: FilterOf, config: Make, imu: Make) -> None:
    """Turning at 2 rad/s, an IMU half a metre ahead feels 2 m/s^2 towards the centre, which stands still."""
    localization = filter_of(imu0="a", imu0_config=config("vyaw"), imu1="b", imu1_config=config("ax", "ay"))
    localization.frames.add_static("base_link", "front", _place(0.5))
    _take(localization, "imu0", imu(SECOND, omega=(0.0, 0.0, 2.0)))
    state, _ = _take(localization, "imu1", imu(SECOND, force=(-2.0, 0.0, 0.0), frame="front"))
    assert state[ACCELERATION] == pytest.approx([0.0, 0.0, 0.0], abs=1e-6)


@pytest.mark.parametrize("missing", ["omega", "force"])
def test_what_an_imu_does_not_measure_is_left_out(
    filter_of: FilterOf, config: Make, imu: Make, missing: str
) -> None:
    localization = filter_of(imu0="i", imu0_config=config("vyaw", "ax"))
    values = {"omega": (0.0, 0.0, 1.0), "force": (1.0, 0.0, 0.0), missing: None}
    state, _ = _take(localization, "imu0", imu(SECOND, **values))
    assert state[VYAW] == (0.0 if missing == "omega" else 1.0)
    assert state[ACCELERATION][0] == (0.0 if missing == "force" else 1.0)


def test_two_dimensions_hold_the_rest_at_zero(filter_of: FilterOf, config: Make, twist: Make) -> None:
    localization = filter_of(twist0="t", twist0_config=config("vx", "vz", "vroll"), two_d_mode=True)
    state, covariance = _take(
        localization, "twist0", twist(SECOND, (1.0, 2.0, 3.0, 4.0, 5.0, 6.0), variance=0.5)
    )
    assert state[VX] == 1.0
    assert np.count_nonzero(state) == 1
    pinned = [Z, 3, 4, 8, 9, 10, 14]
    assert (covariance[pinned, pinned] == 1e-6).all()
    assert covariance[VX, VX] == 0.5


def test_entries_that_are_not_numbers_are_left_out(filter_of: FilterOf, config: Make, twist: Make) -> None:
    localization = filter_of(twist0="t", twist0_config=config("vx", "vy"))
    messages = [twist(stamp * SECOND, (1.0, math.nan, 0, 0, 0, 0)) for stamp in (1, 2)]
    state, _ = _take(localization, "twist0", *messages)
    assert state[[VX, VY]] == pytest.approx([1.0, 0.0], abs=1e-6)


@pytest.mark.parametrize(("length", "told"), [(1.0, False), (1.005, False), (2.0, True), (0.0, True)])
def test_quaternions_of_a_wrong_length_are_told(
    filter_of: FilterOf, config: Make, pose: Make, length: float, *, told: bool
) -> None:
    localization = filter_of(pose0="p", pose0_config=config("yaw"))
    message = pose(SECOND, (0.0,) * 6)
    message.pose.pose.orientation.w = length
    _take(localization, "pose0", message)
    assert ("pose0_orientation" in localization.notices.take()) is told


def test_doubtful_variances_are_told_with_diagnostics(filter_of: FilterOf, config: Make, twist: Make) -> None:
    localization = filter_of(twist0="t", twist0_config=config("vx", "vy"), print_diagnostics=True)
    _take(localization, "twist0", twist(SECOND, (0.0,) * 6, variance=0.0))
    _, text = localization.notices.take()["twist0_covariance"]
    assert "X_VELOCITY 0, Y_VELOCITY 0" in text


def test_a_measurement_beyond_its_threshold_is_told_and_not_fused(
    filter_of: FilterOf, config: Make, twist: Make
) -> None:
    localization = filter_of(twist0="t", twist0_config=config("vx"), twist0_rejection_threshold=3.0)
    still, jump = twist(SECOND, (0.0,) * 6), twist(SECOND + 1000, (50.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    state, _ = _take(localization, "twist0", still, jump)
    assert state[VX] == 0.0
    assert set(localization.notices.take()) == {"twist0_rejected"}
