"""Errors that are as large as the covariance says are found to be so, and others are not."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from bringup.evaluation.chi_square import mean_bounds
from bringup.evaluation.errors import against_truth, deviations, inside, nees, position_rms, row_at
from bringup.evaluation.track import Track


def test_honest_errors_have_the_nees_of_their_number_of_variables(track: Callable[..., Track]) -> None:
    honest = track(rows=400)
    low, high = mean_bounds(0.999, 3, 400)
    assert low < nees(honest).mean() < high
    assert 0.92 < inside(honest).mean() < 0.98


def test_errors_twice_as_large_as_told_are_found_outside(track: Callable[..., Track]) -> None:
    assert nees(track(excess=2.0)).mean() == pytest.approx(4.0 * nees(track()).mean())
    assert inside(track(excess=2.0)).mean() < 0.8


def test_correlated_errors_are_judged_along_their_own_axes(track: Callable[..., Track]) -> None:
    """An error along the long axis of the ellipse weighs less than the same one across it."""
    one = track(rows=2)
    covariance = np.tile(np.array([[1.0, 0.9, 0.0], [0.9, 1.0, 0.0], [0.0, 0.0, 1.0]]), (2, 1, 1))
    filtered = one.truth + np.array([(1.0, 1.0, 0.0), (1.0, -1.0, 0.0)])
    along, across = nees(replace(one, filtered=filtered, covariance=covariance))
    assert along == pytest.approx(2.0 / 1.9)
    assert across == pytest.approx(2.0 / 0.1)


def test_headings_differ_by_the_smaller_angle() -> None:
    errors = against_truth(np.array([[0.0, 0.0, math.pi - 0.1]]), np.array([[0.0, 0.0, 0.1 - math.pi]]))
    assert errors[0, 2] == pytest.approx(-0.2)


def test_the_rms_is_of_distances_in_the_plane() -> None:
    assert position_rms(np.array([(3.0, 4.0, 9.0), (0.0, 0.0, 9.0)])) == pytest.approx(math.sqrt(12.5))


def test_deviations_and_rows(track: Callable[..., Track]) -> None:
    one = track()
    assert deviations(one)[0, 0] == pytest.approx(0.04)
    assert one.times[row_at(one, 30.04)] == pytest.approx(30.0)
