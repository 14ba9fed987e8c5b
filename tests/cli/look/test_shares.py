"""Pieces of work are each taken once, and nobody is idle while there are some."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from orchestra.cli.look.shares import Shares


@given(st.integers(1, 200), st.integers(1, 5), st.lists(st.tuples(st.integers(0, 4), st.floats(0, 0.1))))
def test_each_piece_is_taken_once(pieces: int, workers: int, turns: list[tuple[int, float]]) -> None:
    shares, taken = Shares(pieces, workers), []
    for worker, seconds in (*turns, *[(0, 0.0)] * pieces):
        if shares.left:
            given_now = shares.take(worker % workers)
            assert given_now
            taken += given_now
            shares.took(worker % workers, seconds)
    assert shares.left == 0
    assert sorted(taken) == list(range(pieces))


def test_neighbours_stay_together_until_one_is_done_with_his() -> None:
    shares = Shares(100, 2)
    first, second = shares.take(0), shares.take(1)
    assert (first, second) == ([0], [50])
    shares.took(0, 0.0)
    assert shares.take(0) == [1, 2]
    while len(taken := shares.take(1)) and taken[0] >= 50:
        shares.took(1, 0.0)
    assert taken[0] == 26, "half of what the other one has left"


def test_what_is_slow_is_handed_over_one_by_one() -> None:
    shares = Shares(100, 2)
    for _ in range(8):
        shares.take(0)
        shares.took(0, 0.0)
    assert len(shares.take(0)) > 8
    for _ in range(8):
        shares.took(0, 1.0)
    assert len(shares.take(0)) == 1


def test_what_was_put_back_comes_first() -> None:
    shares = Shares(10, 1)
    shares.take(0)
    shares.took(0, 0.0)
    assert shares.take(0) == [1, 2]
    shares.put_back(0, [2])
    assert shares.left == 8
    assert shares.take(0)[0] == 2
