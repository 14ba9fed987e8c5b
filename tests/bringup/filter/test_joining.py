"""Measurements of one moment give the same estimate together, one by one, and in any parts."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bringup.filter import kalman
from bringup.filter.joining import Joiner
from bringup.filter.localization import Localization
from bringup.filter.measurement import Measurement
from bringup.filter.settings import NANOSECONDS, NEVER_REJECT
from bringup.filter.state import Array, Indices
from bringup.filter.variances import Noise, judged

Make = Callable[..., Any]
SECOND = NANOSECONDS


def _covariance(random: np.random.Generator, size: int) -> Array:
    spread = random.normal(size=(size, size))
    return spread @ spread.T + np.eye(size) * 0.1


@settings(max_examples=40)
@given(st.integers(0, 2**32 - 1), st.permutations(range(15)), st.sets(st.integers(1, 14)))
def test_a_batch_and_any_split_of_it_agree(seed: int, order: list[int], cuts: set[int]) -> None:
    """Angles stay within half a turn of each other; across the seam, what is nearer depends on the order."""
    random = np.random.default_rng(seed)
    prior, covariance = random.normal(size=15) * 0.2, _covariance(random, 15)
    values = prior + random.normal(size=15) * 0.2
    groups = np.split(np.array(order, dtype=np.intp), sorted(cuts))
    noise = np.zeros((15, 15))
    for group in groups:
        noise[np.ix_(group, group)] = _covariance(random, len(group))
    every = np.arange(15, dtype=np.intp)
    whole = kalman.correct(prior, covariance, every, values.tolist(), noise)
    state, after = prior, covariance
    for group in groups:
        corrected = kalman.correct(state, after, group, values[group].tolist(), noise[np.ix_(group, group)])
        assert corrected is not None
        state, after = corrected
    assert whole is not None
    assert state == pytest.approx(whole[0], abs=1e-8)
    assert after == pytest.approx(whole[1], abs=1e-8)


def _part(name: str, indices: list[int], stamp: int = SECOND, **more: Any) -> Measurement:
    where = np.array(indices, dtype=np.intp)
    noise = np.eye(len(indices)) * 0.5
    return Measurement(
        stamp, name, where, tuple(map(float, range(len(indices)))), noise, NEVER_REJECT, **more
    )


def test_parts_that_measure_different_variables_become_one() -> None:
    (joint,) = Joiner().join([_part("a", [3, 4]), _part("b", [9])])
    assert joint.part == "a+b"
    assert joint.indices.tolist() == [3, 4, 9]
    assert joint.values == (0.0, 1.0, 0.0)


@pytest.mark.parametrize(
    "parts",
    [
        [_part("a", [6, 7]), _part("b", [7])],
        [
            _part("a", [6]),
            Measurement(1, "b", np.array([7], dtype=np.intp), (0.0,), np.eye(1), threshold=3.0),
        ],
        [_part("a", [6])],
    ],
)
def test_parts_of_one_variable_or_with_a_threshold_stay_apart(parts: list[Measurement]) -> None:
    assert list(Joiner().join(parts)) == parts


@pytest.mark.parametrize("two_d_mode", [True, False])
def test_joined_parts_give_the_estimate_that_single_ones_do(
    filter_of: Callable[..., Localization], config: Make, imu: Make, *, two_d_mode: bool
) -> None:
    """A threshold that nothing reaches keeps the parts apart; the first message is the same for both."""
    estimates = []
    for threshold in (1e6, NEVER_REJECT):
        names = ("pose", "twist", "linear_acceleration")
        localization = filter_of(
            imu0="i",
            imu0_config=config("yaw", "vyaw", "vpitch", "ax", "az"),
            imu1="first",
            imu1_config=config("ax"),
            two_d_mode=two_d_mode,
            **{f"imu0_{name}_rejection_threshold": threshold for name in names},
        )
        localization.receive("imu1", imu(SECOND, force=(0.0, 0.0, 0.0)), 0)
        localization.update(SECOND)
        for number in range(1, 20):
            stamp = SECOND + number * SECOND // 10
            message = imu(stamp, rpy=(0.0, 0.0, 0.01 * number), omega=(0.0, 0.1, 0.1), force=(0.1, 0.0, 0.2))
            message.orientation_covariance[:] = (np.eye(3) * 1e-3).reshape(-1)
            localization.receive("imu0", message, stamp)
            localization.update(stamp)
        estimate = localization.estimate()
        assert estimate is not None
        assert localization.notices.take() == {}
        estimates.append(estimate)
    assert estimates[0].state == pytest.approx(estimates[1].state, abs=1e-10)
    assert estimates[0].covariance == pytest.approx(estimates[1].covariance, abs=1e-10)


def test_a_message_of_three_parts_costs_one_correction_and_its_covariance_is_judged_once(
    filter_of: Callable[..., Localization], config: Make, imu: Make, monkeypatch: pytest.MonkeyPatch
) -> None:
    judgements: list[Array] = []

    def judging(covariance: Array, indices: Indices) -> Noise:
        judgements.append(covariance)
        return judged(covariance, indices)

    monkeypatch.setattr("bringup.filter.mounting.judged", judging)
    localization = filter_of(imu0="i", imu0_config=config("roll", "yaw", "vyaw", "ax", "ay"))
    corrections: list[Measurement] = []
    localization.observe(lambda measurement, _state, _covariance: corrections.append(measurement))
    for number in range(1, 12):
        stamp = number * SECOND // 10
        message = imu(stamp, rpy=(0.0, 0.0, 0.1), omega=(0.0, 0.0, 0.1), force=(0.1, 0.0, 0.0))
        localization.receive("imu0", message, stamp)
        localization.update(stamp)
    assert len(corrections) == 10, "the first message is taken over"
    assert len(judgements) == 3, "one for each part"


@pytest.mark.parametrize("two_d_mode", [True, False])
def test_sensors_of_one_stamp_are_fused_together_and_give_what_each_by_itself_gives(
    filter_of: Callable[..., Localization], config: Make, imu: Make, twist: Make, *, two_d_mode: bool
) -> None:
    """Who observes a filter gets each measurement by itself."""
    estimates, together = [], []
    for observed in (True, False):
        localization = filter_of(
            imu0="i",
            imu0_config=config("vyaw", "ax"),
            twist0="t",
            twist0_config=config("vx", "vy"),
            twist1="other",
            twist1_config=config("vz"),
            two_d_mode=two_d_mode,
        )
        if observed:
            localization.observe(lambda _measurement, _state, _covariance: together.append(1))
        for number in range(1, 15):
            stamp = number * SECOND // 10
            speed, turning = (1.0, 0.1, 0.2 * number, 0.0, 0.0, 0.0), (0.0, 0.0, 0.1 * number)
            localization.receive("twist0", twist(stamp, speed, variance=1e-3), stamp)
            localization.receive("imu0", imu(stamp, omega=turning, force=(0.1, 0.0, 0.0)), stamp)
            if number % 2:
                localization.receive("twist1", twist(stamp, speed, variance=1e-2), stamp)
            localization.update(stamp)
        estimate = localization.estimate()
        assert estimate is not None
        estimates.append(estimate)
    assert len(together) == 14 * 2 + 7 - 1, "all but the very first, which is taken over"
    assert estimates[0].state == pytest.approx(estimates[1].state, abs=1e-10)
    assert estimates[0].covariance == pytest.approx(estimates[1].covariance, abs=1e-10)


def test_what_is_measured_twice_at_one_moment_counts_twice(
    filter_of: Callable[..., Localization], config: Make, twist: Make
) -> None:
    localization = filter_of(
        twist0="a", twist0_config=config("vx"), twist1="b", twist1_config=config("vx", "vy")
    )
    for second in (1, 2):
        for sensor, speed in (("twist0", 1.0), ("twist1", 3.0)):
            message = twist(second * SECOND, (speed, 0.0, 0.0, 0.0, 0.0, 0.0), variance=1e-4)
            localization.receive(sensor, message, second * SECOND)
    localization.update(2 * SECOND)
    estimate = localization.estimate()
    assert estimate is not None
    assert estimate.state[6] == pytest.approx(2.0, abs=0.01)


def test_covariances_that_always_change_are_not_remembered_for_ever(
    filter_of: Callable[..., Localization], config: Make, imu: Make, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("bringup.filter.joining._KEPT", 2)
    localization = filter_of(imu0="i", imu0_config=config("yaw", "vyaw"))
    for number in range(1, 8):
        message = imu(number * SECOND, rpy=(0.0, 0.0, 0.5), omega=(0.0, 0.0, 0.1), variance=1e-4 * number)
        localization.receive("imu0", message, number * SECOND)
        localization.update(number * SECOND)
    estimate = localization.estimate()
    assert estimate is not None
    assert estimate.state[11] == pytest.approx(0.1, abs=1e-3)


@given(st.integers(0, 2**32 - 1), st.integers(1, 6), st.sampled_from([0.0, -1.0, 1e-12, 1.0, 1e6]))
def test_any_covariance_can_be_used(seed: int, size: int, scale: float) -> None:
    """Whatever a driver writes into it, what is used is symmetric and positive."""
    covariance = np.random.default_rng(seed).normal(size=(size, size)) * scale
    usable = judged(covariance, np.arange(size)).matrix
    assert np.array_equal(usable, usable.T)
    assert np.linalg.eigvalsh(usable).min() > 0.0


@pytest.mark.parametrize("unknown", [np.inf, np.nan])
def test_a_variance_that_is_no_number_gives_no_weight(
    filter_of: Callable[..., Localization], config: Make, twist: Make, unknown: float
) -> None:
    localization = filter_of(twist0="t", twist0_config=config("vx", "vy"), print_diagnostics=True)
    for second, vy in ((1, 0.0), (2, 5.0)):
        message = twist(second * SECOND, (1.0, vy, 0.0, 0.0, 0.0, 0.0))
        message.twist.covariance[7] = 1e-6 if second == 1 else unknown
        localization.receive("twist0", message, 0)
        localization.update(second * SECOND)
    estimate = localization.estimate()
    assert estimate is not None
    assert estimate.state[[6, 7]] == pytest.approx([1.0, 0.0], abs=1e-6)
    assert np.isfinite(estimate.covariance).all()
    assert "Y_VELOCITY" in localization.notices.take()["twist0_covariance"][1]
