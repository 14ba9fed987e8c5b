from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.supervise.process.backoff import Again, decide
from orchestra.values import Policy, Restart


@pytest.mark.conforms("4.8 respawn", "D30")
@pytest.mark.parametrize(
    ("policy", "success", "again"),
    [
        ("no", True, False),
        ("no", False, False),
        ("on-failure", True, False),
        ("on-failure", False, True),
        ("always", True, True),
        ("always", False, True),
    ],
)
def test_the_policy_decides(policy: Policy, success: bool, again: bool) -> None:
    assert (decide(Restart(policy), success=success, uptime=1.0, short_runs=0) is not None) is again


def test_nothing_written_means_no_restart() -> None:
    assert decide(None, success=False, uptime=1.0, short_runs=0) is None


@pytest.mark.conforms("D30", "4.8 delay")
@pytest.mark.parametrize(
    ("delay", "pauses"),
    [
        (0.0, [0, 1, 2, 4, 8, 16, 30, 30]),
        (0.1, [0.1, 1, 2, 4, 8, 16, 30, 30]),
        (3.0, [3, 6, 12, 24, 30, 30]),
        (60.0, [60, 60, 60]),
    ],
)
def test_pauses_grow_while_runs_stay_short(delay: float, pauses: list[float]) -> None:
    assert _pauses(Restart("always", delay), len(pauses)) == pauses


def test_a_program_that_crashes_at_once_starts_five_times_in_ten_seconds() -> None:
    now, starts = 0.0, 1
    for pause in _pauses(Restart("always"), 20):
        now += pause
        starts += now < 10.0
    assert starts == 5


def test_a_good_run_makes_the_next_pause_short_again() -> None:
    assert decide(Restart("always", 2.0), success=False, uptime=10.0, short_runs=7) == Again(2.0, 0.0, 0)


@pytest.mark.conforms("4.8 retries", "D30")
def test_the_budget_counts_short_runs_in_a_row() -> None:
    """Upstream's `respawn_max_retries: 2` means three starts."""
    restart = Restart("always", budget=2)
    short_runs, starts = 0, 1
    while again := decide(restart, success=False, uptime=0.1, short_runs=short_runs):
        short_runs = again.short_runs
        starts += 1
    assert starts == 3


@given(st.floats(0, 100), st.floats(0, 100), st.integers(0, 10_000))
def test_a_pause_is_never_shorter_than_asked_nor_longer_than_the_cap(
    delay: float, cap: float, short_runs: int
) -> None:
    again = decide(Restart("always", delay, max_delay=cap), success=False, uptime=0.0, short_runs=short_runs)
    assert again is not None
    assert delay <= again.delay <= max(delay, cap)


def _pauses(restart: Restart, count: int) -> list[float]:
    pauses: list[float] = []
    short_runs = 0
    for _ in range(count):
        again = decide(restart, success=False, uptime=0.0, short_runs=short_runs)
        assert again is not None
        pauses.append(again.delay)
        short_runs = again.short_runs
    return pauses
