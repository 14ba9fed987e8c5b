"""Maps and ways: what beams mark and clear, and that the way found is the shortest that keeps clear."""

import heapq
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from bringup.control.command import Pose
from bringup.control.costs import CLOSED, costs, squared_distances
from bringup.control.grid import MARGIN, REACH, Grid, about, covering, marked, world
from bringup.control.route import distances, found
from bringup.control.way import advanced, is_free, remaining

NOTHING = np.empty((0, 2))
RADIUS = 0.32
HIT = 12


def drawn(picture: str, resolution: float = 0.1) -> Grid:
    """A grid from lines of text, the first one the highest; # is an obstacle."""
    rows = [[HIT if sign == "#" else 0 for sign in line] for line in reversed(picture.split())]
    return Grid(resolution, 0, 0, np.array(rows, dtype=np.int8))


WALL = """
....................
....................
....................
....................
..........#.........
..........#.........
..........#.........
..........#.........
..........#.........
..........#.........
"""


@settings(max_examples=20)
@given(x=st.floats(-3, 3), y=st.floats(-3, 3), yaw=st.floats(-3, 3))
def test_a_wall_is_marked_where_it_is_from_wherever_it_is_seen(x: float, y: float, yaw: float) -> None:
    wall = np.column_stack((np.full(41, 4.0), np.linspace(-2, 2, 41)))
    eye = Pose(x, y, yaw)
    cos, sin = math.cos(yaw), math.sin(yaw)
    seen = (wall - (x, y)) @ np.array([[cos, -sin], [sin, cos]])
    near = np.hypot(*seen.T) < REACH
    grid = marked(about(np.array([[x, y]]), 0.05), eye, seen, NOTHING)
    places = grid.cells(world(eye, seen[near]))
    assert grid.occupied[places[:, 0], places[:, 1]].all()
    assert np.allclose(world(eye, seen), wall)
    assert grid.occupied.sum() <= near.sum()


def test_what_has_gone_is_cleared_by_beams_that_pass_its_place() -> None:
    grid = about(np.array([[0.0, 0.0]]), 0.05)
    eye, thing, wall = Pose(0.0, 0.0, 0.0), np.array([[1.0, 0.0]]), np.array([[3.0, 0.0]])
    for _ in range(20):
        grid = marked(grid, eye, thing, NOTHING)
    assert grid.occupied.sum() == 1
    for _ in range(12):
        grid = marked(grid, eye, wall, NOTHING)
    [[row, column]] = grid.cells(thing)
    assert not grid.occupied[row, column]
    [[row, column]] = grid.cells(wall)
    assert grid.occupied[row, column]


def test_a_beam_without_a_hit_clears_as_well_and_marks_nothing() -> None:
    grid = marked(about(np.array([[0.0, 0.0]]), 0.05), Pose(0.0, 0.0, 0.0), NOTHING, np.array([[12.0, 0.0]]))
    assert not grid.occupied.any()
    assert (grid.evidence < 0).sum() > 100


@settings(max_examples=20)
@given(
    points=st.lists(st.tuples(st.floats(-20, 20), st.floats(-20, 20)), min_size=1, max_size=5),
    more=st.lists(st.tuples(st.floats(-20, 20), st.floats(-20, 20)), min_size=1, max_size=5),
)
def test_a_grid_grows_with_a_margin_and_keeps_what_it_has(
    points: list[tuple[float, float]], more: list[tuple[float, float]]
) -> None:
    grid = about(np.array(points), 0.1)
    [[row, column]] = grid.cells(np.array(points[:1]))
    grid.evidence[row, column] = 7
    grown = covering(grid, np.array(more))
    for x, y in points + more:
        [[row, column]] = grown.cells(np.array([(x, y)]))
        rows, columns = grown.evidence.shape
        assert MARGIN / 0.1 - 1 <= row < rows - MARGIN / 0.1 + 1
        assert MARGIN / 0.1 - 1 <= column < columns - MARGIN / 0.1 + 1
    assert (grown.evidence > 0).sum() == 1
    [[row, column]] = grown.cells(np.array(points[:1]))
    assert grown.evidence[row, column] == 7


@settings(max_examples=20)
@given(st.integers(0, 2**32 - 1), st.floats(0.0, 0.2), st.integers(1, 14))
def test_distances_to_the_nearest_obstacle_are_right_as_far_as_they_are_asked_for(
    seed: int, share: float, most: int
) -> None:
    cells = np.random.default_rng(seed).random((10, 12)) < share
    rows, columns = np.nonzero(cells)
    squares = squared_distances(cells, most)
    for row in range(10):
        for column in range(12):
            expected = ((rows - row) ** 2 + (columns - column) ** 2).min(initial=10_000)
            if expected <= most * most:
                assert squares[row, column] == expected
            else:
                assert squares[row, column] > most * most


def dijkstra(price: NDArray[np.int32], end: tuple[int, int]) -> NDArray[np.int64]:
    """The plain way to the same field."""
    field = np.full(price.shape, 10**12)
    queue = [(0, end)]
    while queue:
        far, cell = heapq.heappop(queue)
        if far >= field[cell]:
            continue
        field[cell] = far
        for step in ((0, 1), (1, 0), (0, -1), (-1, 0)):
            other = cell[0] + step[0], cell[1] + step[1]
            if min(other) >= 0 and other[0] < price.shape[0] and other[1] < price.shape[1]:
                heapq.heappush(queue, (far + int(price[other]), other))
    return field


@settings(max_examples=20)
@given(st.integers(0, 2**32 - 1))
def test_sweeps_find_what_dijkstra_finds(seed: int) -> None:
    prices = np.array([1, 1, 1, 2, 5, CLOSED], dtype=np.int32)
    price = np.random.default_rng(seed).choice(prices, (15, 10))
    price[0, 0] = 1
    field, expected = distances(price, np.array([[0, 0]])), dijkstra(price, (0, 0))
    open_ones = expected < CLOSED
    assert (field[open_ones] == expected[open_ones]).all()
    assert (field[~open_ones] >= CLOSED).all()


def test_a_way_goes_around_a_wall_and_keeps_clear_of_it() -> None:
    priced = costs(drawn(WALL), 0.15)
    way = found(priced, Pose(0.35, 0.25, 0.0), (1.75, 0.25), 0.05)
    assert way is not None
    here = Pose(0.35, 0.25, 0.0)
    assert is_free(way, here)
    assert way.corners[-1].tolist() == [1.75, 0.25]
    assert way.corners[:, 1].max() > 0.7
    assert 1.4 < remaining(way, here) < 2.2


def test_in_the_open_the_way_is_straight() -> None:
    here = Pose(0.15, 0.15, 0.0)
    way = found(costs(drawn("....................\n" * 12), 0.15), here, (1.75, 1.05), 0.05)
    assert way is not None
    assert remaining(way, here) == pytest.approx(math.hypot(1.6, 0.9), abs=0.03)
    assert len(advanced(way, here).corners) == 1


@pytest.mark.parametrize(
    ("name", "x", "y", "reached"),
    [
        ("beside the wall", 1.55, 0.15, True),
        ("in the wall", 1.05, 0.25, False),
        ("too near to the wall", 1.25, 0.25, False),
    ],
)
def test_a_place_without_room_has_no_way(name: str, x: float, y: float, reached: bool) -> None:
    way = found(costs(drawn(WALL), RADIUS), Pose(0.35, 0.25, 0.0), (x, y), 0.08)
    assert (way is not None) == reached, name


def test_a_robot_that_stands_too_near_to_something_is_led_out_first() -> None:
    here = Pose(0.85, 0.25, 0.0)
    way = found(costs(drawn(WALL), RADIUS), here, (0.35, 0.25), 0.05)
    assert way is not None
    assert way.corners[0][0] < 0.85
