import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bringup.world.body import WHEEL_RADIUS, WHEEL_SEPARATION
from bringup.world.drive import STILL, Limits, Twist, limited, ramped, wheel_speeds

LIMITS = Limits(
    linear_velocity=0.8,
    angular_velocity=1.5,
    linear_acceleration=1.0,
    angular_acceleration=4.0,
    linear_deceleration=2.0,
)
numbers = st.floats(-5.0, 5.0)


@pytest.mark.parametrize(
    ("command", "obeyed"),
    [
        (Twist(0.3, -0.4), Twist(0.3, -0.4)),
        (Twist(9.0, -9.0), Twist(0.8, -1.5)),
        (Twist(math.nan, 0.1), STILL),
        (Twist(0.1, math.inf), STILL),
    ],
)
def test_a_command_is_obeyed_within_the_limits(command: Twist, obeyed: Twist) -> None:
    assert limited(command, LIMITS) == obeyed


def test_speed_is_reached_and_left_at_the_acceleration_limit() -> None:
    assert ramped(STILL, Twist(0.8, 1.5), LIMITS, 0.1) == Twist(0.1, 0.4)
    assert ramped(Twist(0.8, 0.0), STILL, LIMITS, 0.1).linear == pytest.approx(0.6)
    assert ramped(Twist(-0.8, 0.0), Twist(-0.1, 0.0), LIMITS, 0.1).linear == pytest.approx(-0.6)
    assert ramped(Twist(0.05, 0.1), STILL, LIMITS, 0.1) == STILL


@given(numbers, numbers)
def test_wheels_give_back_the_motion_they_are_made_from(linear: float, angular: float) -> None:
    left, right = wheel_speeds(Twist(linear, angular))
    assert WHEEL_RADIUS * (left + right) / 2 == pytest.approx(linear, abs=1e-9)
    assert WHEEL_RADIUS * (right - left) / WHEEL_SEPARATION == pytest.approx(angular, abs=1e-9)
