"""What the filter finds doesn't depend on which way the world's axes point."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bringup.filter import kalman
from bringup.filter.localization import Localization
from bringup.filter.rotation import (
    matrix_from_quaternion,
    matrix_from_rpy,
    quaternion_from_rpy,
    rpy_from_matrix,
    rpy_from_quaternion,
    up_seen_by,
)
from bringup.filter.settings import NANOSECONDS
from bringup.filter.state import NAMES, Array, wrap

Make = Callable[..., Any]
SECOND = NANOSECONDS
angle = st.floats(-math.pi, math.pi)


def _turned(state: Array, covariance: Array, yaw: float) -> tuple[Array, Array]:
    """The same belief in a world whose axes are turned by -yaw: positions and the heading turn, nothing else."""
    turn = np.eye(len(NAMES))
    turn[:3, :3] = matrix_from_rpy(0.0, 0.0, yaw)
    state = turn @ state
    state[5] = wrap(float(state[5] + yaw))
    return state, turn @ covariance @ turn.T


@settings(max_examples=40)
@given(st.integers(0, 2**32 - 1), angle, st.floats(0.001, 1.0))
def test_prediction_turns_with_the_world(seed: int, yaw: float, dt: float) -> None:
    random = np.random.default_rng(seed)
    state = random.normal(size=15)
    state[4] *= 0.3
    spread = random.normal(size=(15, 15))
    covariance, noise = spread @ spread.T, np.diag([0.1] * 15)
    noise[0, 0] = noise[1, 1] = 0.3
    moved = _turned(*kalman.predict(state, covariance, noise, dt), yaw)
    turned = kalman.predict(*_turned(state, covariance, yaw), noise, dt)
    difference = moved[0] - turned[0]
    difference[5] = wrap(float(difference[5]))
    assert difference == pytest.approx(np.zeros(15), abs=1e-9)
    assert moved[1] == pytest.approx(turned[1], rel=1e-9, abs=1e-9)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=10, deadline=None)
@given(st.integers(0, 2**32 - 1), angle)
def test_a_drive_turns_with_the_frame_it_is_seen_in(
    filter_of: Callable[..., Localization], config: Make, odometry: Make, seed: int, yaw: float
) -> None:
    """A robot located by poses and driven by velocities, once in a world and once in one that is turned."""
    random = np.random.default_rng(seed)
    states = []
    samples = random.normal(size=(10, 12)) * 0.3
    for turn in (0.0, yaw):
        localization = filter_of(odom0="o", odom0_config=config("x", "y", "z", "yaw", "vx", "vy", "vyaw"))
        for number, sample in enumerate(samples):
            stamp = SECOND + number * SECOND // 10
            where = matrix_from_rpy(0.0, 0.0, turn) @ sample[:3]
            pose = (*where, 0.0, 0.0, wrap(sample[5] + turn))
            localization.receive("odom0", odometry(stamp, pose=pose, twist=sample[6:], variance=0.1), stamp)
            localization.update(stamp)
        estimate = localization.estimate()
        assert estimate is not None
        states.append((estimate.state, estimate.covariance))
    expected = _turned(*states[0], yaw)
    difference = expected[0] - states[1][0]
    difference[5] = wrap(float(difference[5]))
    assert difference == pytest.approx(np.zeros(15), abs=1e-8)
    # Process noise differs between x and z alone, so turning about z changes nothing.
    assert expected[1] == pytest.approx(states[1][1], abs=1e-8)


@given(st.tuples(*[st.floats(-1e3, 1e3)] * 4))
def test_angles_come_from_a_quaternion_as_from_its_matrix(quaternion: tuple[float, ...]) -> None:
    x, y, z, w = quaternion
    matrix = matrix_from_quaternion((x, y, z, w))
    direct = matrix_from_rpy(*rpy_from_quaternion((x, y, z, w)))
    assert direct == pytest.approx(matrix_from_rpy(*rpy_from_matrix(matrix)), abs=1e-5)
    assert np.array(up_seen_by((x, y, z, w))) == pytest.approx(matrix[2], abs=1e-9)


@given(angle, st.floats(-1.57, 1.57), angle)
def test_angles_survive_the_way_through_a_quaternion(roll: float, pitch: float, yaw: float) -> None:
    back = rpy_from_quaternion(quaternion_from_rpy(roll, pitch, yaw))
    assert matrix_from_rpy(*back) == pytest.approx(matrix_from_rpy(roll, pitch, yaw), abs=1e-5)
