"""How long a node rests between two ticks of simulated time."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bringup.filter.settings import NANOSECONDS
from bringup.filter_node.pace import Pace

PERIOD = NANOSECONDS // 50


def _paced(speed: float, ticks: int = 3) -> tuple[Pace, float]:
    """A pace after some punctual ticks of a clock of this speed, and the real time of the last."""
    pace, real = Pace(), 100.0
    for number in range(ticks):
        real = 100.0 + number * PERIOD / NANOSECONDS / speed
        pace.note(5 * NANOSECONDS + number * PERIOD, real)
    return pace, real


@pytest.mark.parametrize("speed", [1.0, 2.0, 8.0, 50.0])
def test_it_rests_for_most_of_the_way_to_the_next_tick(speed: float) -> None:
    pace, real = _paced(speed)
    assert pace.rest(PERIOD, real) == pytest.approx(0.6 * 0.02 / speed)
    assert pace.rest(PERIOD, real + 0.004 / speed) == pytest.approx(0.4 * 0.02 / speed)


@given(st.floats(1e-3, 1e3), st.integers(-PERIOD, 100 * PERIOD), st.floats(0.0, 10.0))
def test_it_never_rests_beyond_the_tick_nor_for_long(speed: float, to_go: int, later: float) -> None:
    pace, real = _paced(speed)
    rest = pace.rest(to_go, real + later)
    assert 0.0 <= rest <= 0.0125
    assert rest == 0.0 or later + rest < to_go / NANOSECONDS / speed


def test_a_clock_that_nearly_stands_still_may_go_on_at_any_moment() -> None:
    pace, real = _paced(0.01)
    assert pace.rest(PERIOD, real) == pytest.approx(0.012)


@pytest.mark.parametrize("second", [5 * NANOSECONDS, 4 * NANOSECONDS])
def test_without_a_pace_there_is_no_rest(second: int) -> None:
    """Before two ticks, at a clock that goes back, and at one that stands still."""
    pace = Pace()
    assert pace.rest(0, 1.0) == 0.0
    pace.note(5 * NANOSECONDS, 1.0)
    pace.note(second, 2.0)
    assert pace.rest(PERIOD, 2.0) == 0.0
