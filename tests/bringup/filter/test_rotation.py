import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bringup.filter.rotation import (
    Vector,
    cross,
    cross_matrix,
    interpolate,
    matrix_from_quaternion,
    matrix_from_rpy,
    product,
    quaternion_from_rpy,
    rows_of,
    rpy_from_matrix,
)
from bringup.filter.state import wrap

angle = st.floats(-math.pi, math.pi)
attitudes = st.tuples(angle, st.floats(-1.5, 1.5), angle)
vectors = st.tuples(*[st.floats(-10.0, 10.0)] * 3)


@given(attitudes)
def test_angles_quaternions_and_matrices_agree(rpy: tuple[float, float, float]) -> None:
    matrix = matrix_from_rpy(*rpy)
    assert matrix_from_quaternion(quaternion_from_rpy(*rpy)) == pytest.approx(matrix, abs=1e-12)
    assert matrix_from_rpy(*rpy_from_matrix(matrix)) == pytest.approx(matrix, abs=1e-9)


@pytest.mark.parametrize("pitch", [math.pi / 2, -math.pi / 2])
def test_straight_up_and_down_keep_their_attitude(pitch: float) -> None:
    matrix = matrix_from_rpy(0.3, pitch, 0.8)
    assert matrix_from_rpy(*rpy_from_matrix(matrix)) == pytest.approx(matrix, abs=1e-6)


def test_axes_are_fixed_and_taken_in_the_order_roll_pitch_yaw() -> None:
    assert matrix_from_rpy(math.pi / 2, 0.0, math.pi / 2) @ [0.0, 1.0, 0.0] == pytest.approx([0.0, 0.0, 1.0])
    assert matrix_from_rpy(math.pi / 2, 0.0, math.pi / 2) @ [1.0, 0.0, 0.0] == pytest.approx([0.0, 1.0, 0.0])


def test_length_of_a_quaternion_does_not_matter() -> None:
    assert matrix_from_quaternion((0.0, 0.0, 2.0, 2.0)) == pytest.approx(
        matrix_from_rpy(0.0, 0.0, math.pi / 2)
    )
    assert matrix_from_quaternion((0.0, 0.0, 0.0, 0.0)) == pytest.approx(np.eye(3))


@given(vectors, vectors)
def test_cross_products_agree_with_numpy(first: Vector, second: Vector) -> None:
    assert cross(first, second) == pytest.approx(np.cross(first, second))
    assert cross_matrix(np.array(first)) @ second == pytest.approx(np.cross(first, second))


@given(attitudes, vectors)
def test_products_agree_with_numpy(rpy: Vector, turned: Vector) -> None:
    matrix = matrix_from_rpy(*rpy)
    assert product(rows_of(matrix), turned) == pytest.approx(matrix @ turned, abs=1e-12)


@given(st.floats(-1000.0, 1000.0))
def test_wrapped_angles_are_the_same_direction(value: float) -> None:
    assert -math.pi < wrap(value) <= math.pi
    assert math.cos(wrap(value) - value) == pytest.approx(1.0)


def test_minus_pi_wraps_to_pi() -> None:
    assert wrap(-math.pi) == math.pi


@pytest.mark.parametrize("turn", [0.001, 1.0, 3.0])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_interpolation_takes_the_shorter_way(turn: float, sign: float) -> None:
    x, y, z, w = quaternion_from_rpy(0.0, 0.0, turn)
    middle = interpolate((0.0, 0.0, 0.0, 1.0), (sign * x, sign * y, sign * z, sign * w), 0.25)
    assert rpy_from_matrix(matrix_from_quaternion(middle))[2] == pytest.approx(turn / 4)
