"""Scans become points; faulty rays, nothing in reach and too near are told apart."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bringup.control.command import Pose
from bringup.control.sight import moved, obstacle_points

QUARTERS = (-math.pi, math.pi / 2)
LIMITS = (0.12, 12.0)
INF, NAN = math.inf, math.nan

poses = st.builds(Pose, st.floats(-20, 20), st.floats(-20, 20), st.floats(-math.pi, math.pi))


@pytest.mark.parametrize(
    ("ranges", "points"),
    [
        ([1.0, 2.0, 3.0, 4.0], [(-1, 0), (0, -2), (3, 0), (0, 4)]),
        ([INF, INF, INF, INF], []),
        ([INF, INF, 3.0, 12.5], [(3, 0)]),
        ([INF, INF, -INF, INF], [(0.12, 0)]),
        ([INF, INF, 0.0, INF], [(0.12, 0)]),
        ([INF, NAN, 1.0, INF], [(1, 0)]),
    ],
)
def test_rays_become_points(ranges: list[float], points: list[tuple[float, float]]) -> None:
    seen = obstacle_points(ranges, QUARTERS, LIMITS, 0.0)
    assert seen is not None
    assert seen == pytest.approx(np.array(points, dtype=float).reshape(-1, 2), abs=1e-9)


@pytest.mark.parametrize("ranges", [[], [NAN] * 4, [NAN, NAN, 1.0, INF]])
def test_a_scan_that_says_too_little_is_not_trusted(ranges: list[float]) -> None:
    assert obstacle_points(ranges, QUARTERS, LIMITS, 0.0) is None


def test_points_are_told_from_the_axle_and_not_from_the_lidar() -> None:
    seen = obstacle_points([1.0] * 4, QUARTERS, LIMITS, 0.1)
    assert seen is not None
    assert seen == pytest.approx(np.array([(-0.9, 0), (0.1, -1), (1.1, 0), (0.1, 1)]), abs=1e-9)


@given(start=poses, end=poses, bearing=st.floats(-3, 3), distance=st.floats(0.1, 12))
def test_points_stay_where_they_are_while_the_robot_moves(
    start: Pose, end: Pose, bearing: float, distance: float
) -> None:
    point = np.array([[distance * math.cos(bearing), distance * math.sin(bearing)]])
    x, y = start.ahead(bearing, distance)
    seen = moved(point, start, end)[0]
    assert math.hypot(*seen) == pytest.approx(end.distance(x, y), abs=1e-6)
    there = end.ahead(math.atan2(seen[1], seen[0]), math.hypot(*seen))
    assert there == pytest.approx((x, y), abs=1e-6)
