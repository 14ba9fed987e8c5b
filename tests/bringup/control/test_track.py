"""Where the robot was when a scan was taken."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bringup.control.command import Pose
from bringup.control.track import KEPT, Track, at, extended


def driven(*steps: tuple[float, float, float]) -> Track:
    """A track of times, places ahead and headings."""
    track = Track()
    for time, x, yaw in steps:
        track = extended(track, time, Pose(x, 0.0, yaw))
    return track


@pytest.mark.parametrize(
    ("name", "time", "x", "yaw"),
    [
        ("before all", 0.5, 0.0, 3.0),
        ("at one", 1.0, 0.0, 3.0),
        ("between two, over the turn of the angle", 1.25, 0.25, math.pi - 0.14159265 + 0.25 * 0.2831853),
        ("after all", 9.0, 1.0, -3.0),
    ],
)
def test_the_pose_at_a_time_is_between_those_about_it(name: str, time: float, x: float, yaw: float) -> None:
    pose = at(driven((1.0, 0.0, 3.0), (2.0, 1.0, -3.0)), time)
    assert pose is not None
    assert pose.x == pytest.approx(x), name
    assert math.remainder(pose.yaw - yaw, math.tau) == pytest.approx(0.0, abs=1e-6), name


def test_without_odometry_there_is_no_pose() -> None:
    assert at(Track(), 1.0) is None


def test_a_clock_that_was_set_back_leaves_only_what_comes_after() -> None:
    track = extended(driven((5.0, 1.0, 0.0), (5.1, 1.1, 0.0)), 1.0, Pose(7.0, 0.0, 0.0))
    assert track.times == (1.0,)
    assert at(track, 5.1) == Pose(7.0, 0.0, 0.0)


@given(st.lists(st.floats(0.0, 10.0), min_size=1, max_size=60))
def test_a_track_stays_in_order_and_short(times: list[float]) -> None:
    track = Track()
    for time in times:
        track = extended(track, time, Pose(time, 0.0, 0.0))
        assert list(track.times) == sorted(set(track.times))
        assert track.times[-1] - track.times[0] <= KEPT
        assert len(track.times) == len(track.poses)
