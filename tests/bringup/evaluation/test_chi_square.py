"""Quantiles as they stand in tables."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bringup.evaluation.chi_square import mean_bounds, probability, quantile

# NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.4.
TABLE = [
    (0.95, 1, 3.841),
    (0.95, 2, 5.991),
    (0.95, 3, 7.815),
    (0.975, 3, 9.348),
    (0.025, 3, 0.216),
    (0.99, 10, 23.209),
    (0.95, 100, 124.342),
    (0.05, 100, 77.929),
]


@pytest.mark.parametrize(("share", "dof", "value"), TABLE)
def test_quantiles_are_those_of_the_tables(share: float, dof: int, value: float) -> None:
    assert quantile(share, dof) == pytest.approx(value, abs=6e-4)


@given(st.floats(0.001, 0.999), st.integers(1, 400))
def test_a_quantile_is_not_exceeded_with_its_probability(share: float, dof: int) -> None:
    assert probability(quantile(share, dof), dof) == pytest.approx(share, abs=1e-9)


def test_nothing_lies_below_zero() -> None:
    assert probability(0.0, 3) == probability(-1.0, 3) == 0.0


@pytest.mark.parametrize("share", [0.0, 1.0, -0.1, float("nan")])
def test_there_is_no_quantile_of_what_is_no_share(share: float) -> None:
    with pytest.raises(ValueError, match="no quantile"):
        quantile(share, 3)


def test_means_of_many_lie_closely_about_their_expectation() -> None:
    """Bar-Shalom, Li, Kirubarajan, 2001, section 5.4: 50 runs of two variables have [1.5, 2.6]."""
    assert mean_bounds(0.95, 2, 50) == pytest.approx((1.48, 2.59), abs=0.01)
