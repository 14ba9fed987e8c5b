"""When measurements are fused, which are ignored, and how time passes without any."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from bringup.filter.localization import Estimate, Localization, UnusablePoseError
from bringup.filter.rotation import quaternion_from_rpy
from bringup.filter.settings import NANOSECONDS
from bringup.filter.state import ACCELERATION, POSE, VX, VYAW, X, Y
from bringup.filter.transforms import Sample

Make = Callable[..., Any]
FilterOf = Callable[..., Localization]
SECOND = NANOSECONDS


@pytest.fixture
def speed(twist: Make) -> Make:
    """A message that says how fast the robot drives forward."""
    return lambda stamp, vx, variance=1e-6: twist(round(stamp * SECOND), (vx, 0, 0, 0, 0, 0), variance)


def _at(localization: Localization, now: float, *messages: Any) -> Estimate | None:
    for message in messages:
        localization.receive("twist0", message, round(now * SECOND))
    localization.update(round(now * SECOND))
    return localization.estimate()


def _stamp(estimate: Estimate | None) -> float:
    assert estimate is not None
    return estimate.stamp / SECOND


def _state(estimate: Estimate | None) -> np.ndarray:
    assert estimate is not None
    return estimate.state


@pytest.fixture
def driving(filter_of: FilterOf, config: Make) -> Callable[..., Localization]:
    return lambda **parameters: filter_of(twist0="t", twist0_config=config("vx"), **parameters)


def test_measurements_from_the_future_wait(driving: FilterOf, speed: Make) -> None:
    localization = driving(sensor_timeout=0.1)
    assert _stamp(_at(localization, 1.0, speed(1.0, 1.0), speed(2.0, 3.0))) == 1.0
    assert _stamp(_at(localization, 1.9)) == 1.0, (
        "a waiting measurement means that the sensors are not silent"
    )
    assert _stamp(_at(localization, 2.0)) == 2.0


def test_measurements_are_fused_in_the_order_of_their_stamps(
    filter_of: FilterOf, config: Make, twist: Make
) -> None:
    """Fused as they came, the later one would be applied before the earlier and leave the robot short."""
    localization = filter_of(twist0="a", twist0_config=config("vx"), twist1="b", twist1_config=config("vx"))
    localization.receive("twist0", twist(SECOND, (1.0, 0, 0, 0, 0, 0)), 0)
    localization.receive("twist0", twist(3 * SECOND, (3.0, 0, 0, 0, 0, 0)), 0)
    localization.receive("twist1", twist(2 * SECOND, (1.0, 0, 0, 0, 0, 0)), 0)
    localization.update(3 * SECOND)
    assert _state(localization.estimate())[VX] == pytest.approx(3.0, abs=1e-3)


@pytest.mark.parametrize("missed", [1, 7, 400])
def test_an_update_that_comes_late_gives_what_punctual_ones_would_have_given(
    filter_of: FilterOf, config: Make, twist: Make, imu: Make, missed: int
) -> None:
    """Nothing of what has come in the meantime is lost, whatever the clock jumped over."""
    estimates = []
    for punctual in (True, False):
        localization = filter_of(
            twist0="t", twist0_config=config("vx", "vy"), imu0="i", imu0_config=config("vyaw"), frequency=50
        )
        for number in range(1, missed + 20):
            stamp = SECOND + number * SECOND // 50
            wave = np.sin(number / 9)
            localization.receive("twist0", twist(stamp, (wave, 0, 0, 0, 0, 0), variance=1e-3), stamp)
            localization.receive("imu0", imu(stamp, omega=(0.0, 0.0, 1.0 - wave), variance=1e-4), stamp)
            if punctual or not 10 <= number < 10 + missed:
                localization.update(stamp)
        estimate = localization.estimate()
        assert estimate is not None
        estimates.append(estimate)
    assert estimates[0].stamp == estimates[1].stamp
    assert estimates[0].state == pytest.approx(estimates[1].state, abs=1e-12)
    assert estimates[0].covariance == pytest.approx(estimates[1].covariance, abs=1e-12)


def test_silence_is_bridged_by_prediction(driving: FilterOf, speed: Make) -> None:
    localization = driving(sensor_timeout=0.5)
    _at(localization, 1.0, speed(1.0, 2.0))
    assert _stamp(_at(localization, 1.4)) == 1.0
    estimate = _at(localization, 1.5)
    assert _stamp(estimate) == 1.5
    assert _state(estimate)[X] == pytest.approx(1.0)


def test_prediction_to_the_present_on_request(driving: FilterOf, speed: Make) -> None:
    localization = driving(sensor_timeout=10.0, predict_to_current_time=True)
    estimate = _at(localization, 1.25, speed(1.0, 2.0))
    assert _stamp(estimate) == 1.25
    assert _state(estimate)[X] == pytest.approx(0.5)


def test_nothing_is_estimated_before_the_first_measurement(driving: FilterOf) -> None:
    localization = driving(predict_to_current_time=True)
    assert _at(localization, 5.0) is None
    assert localization.estimate_to_publish() is None


@pytest.mark.parametrize(("stamp", "accepted"), [(0.0, False), (0.9, False), (1.0, True), (1.1, True)])
def test_messages_out_of_order_and_unstamped_ones_are_ignored(
    driving: FilterOf, speed: Make, stamp: float, *, accepted: bool
) -> None:
    localization = driving()
    _at(localization, 1.0, speed(1.0, 0.0))
    state = _state(_at(localization, 1.2, speed(stamp, 5.0)))
    assert bool(state[VX] > 1.0) is accepted
    assert ("twist0_timestamp" in localization.notices.take()) is not accepted


def test_a_late_measurement_of_another_sensor_counts_as_of_now(
    filter_of: FilterOf, config: Make, twist: Make
) -> None:
    localization = filter_of(twist0="a", twist0_config=config("vx"), twist1="b", twist1_config=config("vx"))
    localization.receive("twist0", twist(2 * SECOND, (1.0, 0, 0, 0, 0, 0)), 0)
    localization.update(2 * SECOND)
    localization.receive("twist1", twist(SECOND, (3.0, 0, 0, 0, 0, 0)), 0)
    localization.update(2 * SECOND)
    estimate = localization.estimate()
    assert _stamp(estimate) == 2.0
    assert _state(estimate)[VX] == pytest.approx(2.0)


def test_an_estimate_is_published_once_unless_corrections_are(driving: FilterOf, speed: Make) -> None:
    for corrections in (False, True):
        localization = driving(sensor_timeout=10.0, permit_corrected_publication=corrections)
        _at(localization, 1.0, speed(1.0, 1.0))
        assert localization.estimate_to_publish() is not None
        _at(localization, 1.1)
        assert (localization.estimate_to_publish() is not None) is corrections


def test_smoothing_gives_what_punctual_data_would_have_given(
    filter_of: FilterOf, config: Make, twist: Make
) -> None:
    """The yaw rate of each second comes two seconds late; without smoothing the way is another."""
    punctual = _drive(filter_of, config, twist, delay=0, smooth=True)
    assert _drive(filter_of, config, twist, delay=2, smooth=True) == pytest.approx(punctual, abs=1e-9)
    assert np.linalg.norm(_drive(filter_of, config, twist, delay=2, smooth=False) - punctual) > 0.1


def test_a_history_that_is_too_short_goes_back_as_far_as_it_can(
    filter_of: FilterOf, config: Make, twist: Make
) -> None:
    state = _drive(filter_of, config, twist, delay=2, smooth=True, history_length=1.5)
    assert np.isfinite(state).all()
    assert state[VYAW] == pytest.approx(0.9, abs=0.1)


def _drive(
    filter_of: FilterOf, config: Make, twist: Make, *, delay: int, smooth: bool, history_length: float = 10.0
) -> np.ndarray:
    localization = filter_of(
        twist0="a",
        twist0_config=config("vx"),
        twist1="b",
        twist1_config=config("vyaw"),
        sensor_timeout=100,
        **({"smooth_lagged_data": True, "history_length": history_length} if smooth else {}),
    )
    for second in range(1, 12):
        now = second * SECOND
        if second < 10:
            localization.receive("twist0", twist(now, (1.0, 0, 0, 0, 0, 0)), now)
        if 1 <= second - delay < 10:
            stamp = now - delay * SECOND + 1
            localization.receive("twist1", twist(stamp, (0, 0, 0, 0, 0, 0.1 * (second - delay)), 1e-3), now)
        localization.update(now + 1)
    return _state(localization.estimate())


def test_set_pose_puts_the_robot_at_rest_there(driving: FilterOf, speed: Make, pose: Make) -> None:
    localization = driving(sensor_timeout=100.0)
    localization.frames.add_static(
        "odom", "dock", Sample(0, (10.0, 0.0, 0.0), quaternion_from_rpy(0.0, 0.0, 1.0))
    )
    _at(localization, 5.0, speed(5.0, 2.0))
    localization.set_pose(pose(5 * SECOND, (0.0,) * 6, 0.5, frame="dock"), 6 * SECOND)
    estimate = localization.estimate_to_publish()
    assert estimate is not None
    assert estimate.state[POSE] == pytest.approx([10.0, 0.0, 0.0, 0.0, 0.0, 1.0])
    assert not estimate.state[VX:].any()
    assert estimate.stamp == 6 * SECOND
    assert np.diag(estimate.covariance) == pytest.approx([0.5] * 6 + [1e-6] * 9)
    assert _state(_at(localization, 6.0, speed(5.0, 9.0)))[VX] == 0.0, "as old as the pose"
    assert _state(_at(localization, 6.1, speed(6.1, 9.0)))[VX] > 1.0


def test_set_pose_in_an_unknown_frame_changes_nothing(driving: FilterOf, speed: Make, pose: Make) -> None:
    localization = driving()
    _at(localization, 5.0, speed(5.0, 2.0))
    with pytest.raises(UnusablePoseError, match="no transform from mars to odom"):
        localization.set_pose(pose(5 * SECOND, (1.0,) * 6, frame="mars"), 6 * SECOND)
    assert _state(localization.estimate())[VX] == 2.0


def test_reset_goes_back_to_the_start(driving: FilterOf, speed: Make) -> None:
    localization = driving(initial_state=[7] + [0] * 14)
    _at(localization, 5.0, speed(5.0, 2.0))
    localization.reset()
    assert localization.estimate() is None
    estimate = _at(localization, 1.0, speed(1.0, 1.0))
    assert _stamp(estimate) == 1.0
    assert _state(estimate)[[X, VX]] == pytest.approx([7.0, 1.0])
    assert localization.estimate_to_publish() is not None


@pytest.mark.parametrize("jumps", [True, False])
def test_a_clock_that_goes_back_resets_only_on_request(
    driving: FilterOf, speed: Make, *, jumps: bool
) -> None:
    localization = driving(use_sim_time=True, reset_on_time_jump=jumps)
    _at(localization, 100.0, speed(100.0, 2.0))
    localization.update(SECOND)
    assert (localization.estimate() is None) is jumps
    estimate = _at(localization, 2.0, speed(2.0, 1.0))
    assert _stamp(estimate) == (2.0 if jumps else 100.0)


def test_a_sensor_whose_stamps_go_back_resets_on_request(driving: FilterOf, speed: Make) -> None:
    localization = driving(use_sim_time=True, reset_on_time_jump=True)
    _at(localization, 100.0, speed(100.0, 2.0))
    localization.receive("twist0", speed(50.0, 1.0), 100 * SECOND)
    localization.update(100 * SECOND)
    assert _state(localization.estimate())[VX] == 1.0
    assert "time_jump" in localization.notices.take()


def test_a_clock_that_is_set_back_is_no_other_time(driving: FilterOf, speed: Make) -> None:
    localization = driving(reset_on_time_jump=True)
    _at(localization, 100.0, speed(100.0, 2.0))
    localization.update(SECOND)
    assert _stamp(localization.estimate()) == 100.0


@pytest.mark.parametrize("waits", [True, False])
def test_a_step_of_years_hardly_moves_the_estimate(driving: FilterOf, speed: Make, *, waits: bool) -> None:
    """Recorded stamps on today's clock, or today's stamps after recorded ones."""
    localization = driving()
    _at(localization, 1.0, speed(1.0, 2.0))
    today = 1_700_000_000.0
    estimate = _at(localization, today) if waits else _at(localization, today, speed(today, 2.0))
    assert _state(estimate)[X] == pytest.approx(0.02, abs=1e-3)
    assert _stamp(estimate) == (1.01 if waits else today)


def test_a_little_disorder_is_no_jump(driving: FilterOf, speed: Make) -> None:
    localization = driving(use_sim_time=True, reset_on_time_jump=True)
    _at(localization, 100.0, speed(100.0, 2.0))
    localization.receive("twist0", speed(99.5, 1.0), 100 * SECOND)
    localization.update(100 * SECOND)
    assert _state(localization.estimate())[VX] == 2.0
    assert set(localization.notices.take()) == {"twist0_timestamp"}


def test_a_disabled_filter_waits_for_its_enabling(driving: FilterOf, speed: Make) -> None:
    localization = driving(disabled_at_startup=True)
    assert _at(localization, 1.0, speed(1.0, 2.0)) is None
    localization.enabled = True
    assert _at(localization, 2.0) is None, "what came before is not fused"
    assert _state(_at(localization, 3.0, speed(3.0, 2.0)))[VX] == 2.0


def test_a_command_is_driven_towards_within_its_limits(driving: FilterOf, speed: Make) -> None:
    localization = driving(
        sensor_timeout=0.01,
        use_control=True,
        control_config=[True, False, False, False, False, True],
        control_timeout=10.0,
        acceleration_limits=[0.5, 1.0, 1.0, 1.0, 1.0, 2.0],
        acceleration_gains=[10.0] * 6,
    )
    _at(localization, 1.0, speed(1.0, 0.0))
    localization.command((1.0, 0.0, 0.0, 0.0, 0.0, 1.0), SECOND)
    state = _state(_at(localization, 1.1))
    assert state[ACCELERATION][0] == pytest.approx(0.5)
    assert state[VX] == pytest.approx(0.05)
    assert state[VYAW] == pytest.approx(0.2)


def test_without_any_command_the_robot_is_taken_to_brake(driving: FilterOf, speed: Make) -> None:
    localization = driving(
        sensor_timeout=0.01, use_control=True, control_config=[True] + [False] * 5, control_timeout=0.5
    )
    _at(localization, 1.0, speed(1.0, 1.0))
    assert _state(_at(localization, 1.1))[VX] == pytest.approx(0.9)


def test_a_command_that_is_too_old_means_braking(driving: FilterOf, speed: Make) -> None:
    localization = driving(
        sensor_timeout=0.01,
        use_control=True,
        control_config=[True] + [False] * 5,
        control_timeout=0.5,
        deceleration_limits=[2.0] * 6,
        deceleration_gains=[100.0] * 6,
    )
    _at(localization, 1.0, speed(1.0, 1.0))
    localization.command((1.0, 0.0, 0.0, 0.0, 0.0, 0.0), SECOND)
    assert _state(_at(localization, 1.6))[ACCELERATION][0] == -2.0


def test_noise_that_grows_with_speed_is_none_at_rest(driving: FilterOf, speed: Make) -> None:
    for velocity, grows in ((0.0, False), (2.0, True)):
        localization = driving(
            sensor_timeout=0.01,
            dynamic_process_noise_covariance=True,
            initial_estimate_covariance=[0.0] * 15,
        )
        estimate = _at(localization, 1.0, speed(1.0, velocity, 0.0))
        estimate = _at(localization, 1.1)
        assert estimate is not None
        assert bool(estimate.covariance[Y, Y] > 1e-4) is grows


def test_a_message_waits_for_the_transform_of_its_time(filter_of: FilterOf, config: Make, pose: Make) -> None:
    localization = filter_of(pose0="p", pose0_config=config("x"), transform_timeout=0.5)
    buffer = localization.frames.buffer
    buffer.add("odom", "beacon", Sample(0, (0.0, 0.0, 0.0), quaternion_from_rpy(0, 0, 0)))
    localization.receive("pose0", pose(SECOND, (0.0,) * 6, frame="beacon"), SECOND)
    localization.update(SECOND + 1)
    assert localization.estimate() is None
    buffer.add("odom", "beacon", Sample(2 * SECOND, (4.0, 0.0, 0.0), quaternion_from_rpy(0, 0, 0)))
    localization.update(SECOND + 2)
    assert _state(localization.estimate())[X] == pytest.approx(2.0)


def test_a_message_that_has_waited_long_enough_takes_the_newest_transform(
    filter_of: FilterOf, config: Make, pose: Make
) -> None:
    localization = filter_of(pose0="p", pose0_config=config("x"), transform_timeout=0.5)
    localization.frames.buffer.add("odom", "beacon", Sample(0, (3.0, 0.0, 0.0), quaternion_from_rpy(0, 0, 0)))
    localization.receive("pose0", pose(SECOND, (0.0,) * 6, frame="beacon"), SECOND)
    localization.update(SECOND + SECOND // 2 - 1)
    assert localization.estimate() is None
    localization.update(SECOND + SECOND // 2)
    assert _state(localization.estimate())[X] == pytest.approx(3.0)


def test_angular_acceleration_is_the_change_of_the_turning_rate(
    filter_of: FilterOf, config: Make, imu: Make
) -> None:
    localization = filter_of(imu0="i", imu0_config=config("vyaw"))
    for stamp, rate in ((1.0, 0.0), (1.5, 1.0)):
        message = imu(round(stamp * SECOND), omega=(0.0, 0.0, rate), variance=1e-9)
        localization.receive("imu0", message, 0)
        localization.update(round(stamp * SECOND))
    estimate = localization.estimate()
    assert estimate is not None
    assert estimate.angular_acceleration == pytest.approx([0.0, 0.0, 2.0], abs=1e-3)
    localization.update(round(1.5 * SECOND))
    again = localization.estimate()
    assert again is not None
    assert np.isfinite(again.angular_acceleration).all()
