import math
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bringup.filter import kalman
from bringup.filter.state import YAW, Array, Indices
from bringup.filter.variances import usable_noise

FOR_EVER = sys.float_info.max


def _at(*indices: int) -> Indices:
    return np.array(indices, dtype=np.intp)


def _correct(
    state: Array, covariance: Array, index: int, value: float, variance: float, threshold: float = FOR_EVER
) -> tuple[Array, Array] | None:
    return kalman.correct(state, covariance, _at(index), [value], np.array([[variance]]), threshold)


def test_one_variable_is_weighed_by_variances() -> None:
    """Prior 1 with variance 3, reading 5 with variance 1: the estimate is 4 with variance 3/4."""
    state, covariance = np.zeros(15), np.eye(15)
    state[0], covariance[0, 0] = 1.0, 3.0
    result = _correct(state, covariance, 0, 5.0, 1.0)
    assert result is not None
    assert result[0][0] == pytest.approx(4.0)
    assert result[1][0, 0] == pytest.approx(0.75)
    assert result[1][1, 1] == 1.0


def test_a_correlated_variable_moves_along() -> None:
    covariance = np.eye(15)
    covariance[0, 1] = covariance[1, 0] = 0.5
    result = _correct(np.zeros(15), covariance, 0, 2.0, 1.0)
    assert result is not None
    assert result[0][:2] == pytest.approx([1.0, 0.5])


@pytest.mark.parametrize(("believed", "read"), [(3.1, -3.1), (-3.1, 3.1), (math.pi, -3.0)])
def test_angles_meet_across_the_seam(believed: float, read: float) -> None:
    state = np.zeros(15)
    state[YAW] = believed
    result = _correct(state, np.eye(15), YAW, read, 1.0)
    assert result is not None
    middle = believed + 0.5 * ((read - believed + math.pi) % (2 * math.pi) - math.pi)
    assert math.cos(result[0][YAW] - middle) == pytest.approx(1.0)
    assert -math.pi < result[0][YAW] <= math.pi


@pytest.mark.parametrize(("threshold", "passes"), [(1.9, False), (2.0, False), (2.1, True), (FOR_EVER, True)])
def test_the_gate_counts_standard_deviations(threshold: float, *, passes: bool) -> None:
    """Prior and reading each have variance 2 and lie 4 apart: two standard deviations; the limit itself is out."""
    result = _correct(np.zeros(15), np.eye(15) * 2.0, 0, 4.0, 2.0, threshold)
    assert (result is not None) is passes


@pytest.mark.parametrize(("given_variance", "used"), [(-0.5, 0.5), (0.0, 1e-9), (1e-12, 1e-9), (0.2, 0.2)])
def test_impossible_variances_are_mended(given_variance: float, used: float) -> None:
    assert usable_noise(np.array([[given_variance]]))[0, 0] == used


@st.composite
def runs(draw: st.DrawFn) -> list[tuple[float, list[int], int]]:
    step = st.tuples(
        st.floats(0.001, 1.0),
        st.lists(st.integers(0, 14), min_size=1, max_size=15, unique=True),
        st.integers(0, 2**16),
    )
    return draw(st.lists(step, min_size=1, max_size=20))


@given(runs())
def test_covariance_stays_symmetric_and_positive(run: list[tuple[float, list[int], int]]) -> None:
    state, covariance = np.zeros(15), np.eye(15) * 1e-9
    noise = np.diag([0.05] * 15)
    for dt, indices, seed in run:
        random = np.random.default_rng(seed)
        state, covariance = kalman.predict(state, covariance, noise, dt)
        spread = random.normal(size=(len(indices), len(indices)))
        reading = random.normal(size=len(indices)).tolist()
        result = kalman.correct(
            state, covariance, _at(*indices), reading, usable_noise(spread @ spread.T), FOR_EVER
        )
        assert result is not None
        state, covariance = result
        assert np.array_equal(covariance, covariance.T)
        assert np.linalg.eigvalsh(covariance).min() > -1e-9 * np.abs(covariance).max()
        assert (np.abs(state[3:6]) <= math.pi).all()
