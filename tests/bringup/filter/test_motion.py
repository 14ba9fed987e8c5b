import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bringup.filter.motion import advance
from bringup.filter.rotation import matrix_from_rpy
from bringup.filter.state import (
    ANGULAR,
    AX,
    LINEAR,
    ORIENTATION,
    PITCH,
    VX,
    VYAW,
    VZ,
    YAW,
    Array,
    X,
    Y,
    Z,
    wrap,
)

_STEP = 1e-6

angle = st.floats(-math.pi, math.pi)
states = st.tuples(
    st.tuples(*[st.floats(-100.0, 100.0)] * 3),
    st.tuples(angle, st.floats(-1.3, 1.3), angle),
    st.tuples(*[st.floats(-5.0, 5.0)] * 9),
).map(lambda parts: np.array([*parts[0], *parts[1], *parts[2]]))


def _state(**values: float) -> Array:
    names = {"x": X, "vx": VX, "vz": VZ, "pitch": PITCH, "yaw": YAW, "vyaw": VYAW, "ax": AX}
    state = np.zeros(15)
    for name, value in values.items():
        state[names[name]] = value
    return state


@given(states, st.floats(0.001, 0.5))
def test_jacobian_is_the_derivative_of_the_motion(state: Array, dt: float) -> None:
    _, jacobian = advance(state, dt)
    for variable in range(15):
        step = np.zeros(15)
        step[variable] = _STEP
        difference = advance(state + step, dt)[0] - advance(state - step, dt)[0]
        difference[ORIENTATION] = [wrap(turn) for turn in difference[ORIENTATION]]
        assert jacobian[:, variable] == pytest.approx(difference / (2 * _STEP), abs=1e-5, rel=1e-5)


@pytest.mark.parametrize(
    ("start", "dt", "end"),
    [
        (_state(vx=2.0), 0.5, _state(x=1.0, vx=2.0)),
        (_state(ax=2.0), 1.0, _state(x=1.0, vx=2.0, ax=2.0)),
        (_state(vyaw=0.5), 2.0, _state(yaw=1.0, vyaw=0.5)),
        (_state(yaw=3.0, vyaw=1.0), 1.0, _state(yaw=4.0 - 2 * math.pi, vyaw=1.0)),
    ],
)
def test_simple_motions_are_exact(start: Array, dt: float, end: Array) -> None:
    assert advance(start, dt)[0] == pytest.approx(end, abs=1e-12)


def test_driving_forward_moves_along_the_heading() -> None:
    moved, _ = advance(_state(vx=1.0, yaw=math.pi / 2), 1.0)
    assert moved[[X, Y, Z]] == pytest.approx([0.0, 1.0, 0.0], abs=1e-12)


def test_nose_down_drives_into_the_ground() -> None:
    """A positive pitch lowers the nose (REP-103)."""
    moved, _ = advance(_state(vx=1.0, pitch=math.pi / 6), 1.0)
    assert moved[Z] == pytest.approx(-0.5)


@given(states)
def test_turning_follows_the_rotation_matrix(state: Array) -> None:
    """For a short time the new attitude is the old one turned by omega in the body's axes."""
    dt = 1e-4
    moved, _ = advance(state, dt)
    x, y, z = state[ANGULAR] * dt
    turned = matrix_from_rpy(*state[ORIENTATION]) @ (
        np.eye(3) + np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    )
    assert matrix_from_rpy(*moved[ORIENTATION]) == pytest.approx(turned, abs=1e-5)


def test_straight_up_is_survived() -> None:
    moved, jacobian = advance(_state(pitch=math.pi / 2, vx=1.0), 0.02)
    assert np.isfinite(moved).all()
    assert np.isfinite(jacobian).all()
    assert moved[LINEAR][0] == 1.0
