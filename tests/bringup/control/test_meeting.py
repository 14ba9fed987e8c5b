"""Two robots whose ways cross: each keeps to its right, and where there is room for one only, one gives way."""

import math
from dataclasses import replace

import numpy as np
import pytest

from bringup.control.command import STANDSTILL, Pose
from bringup.control.costs import CLOSED, costs
from bringup.control.giving_way import (
    LONGEST,
    PARKED,
    PATIENCE,
    SHORTEST,
    Courtesy,
    Giving,
    begun,
    finished,
    is_impatient,
    is_over,
    moved_on,
    patience,
    told_apart,
)
from bringup.control.grid import Grid, about, marked
from bringup.control.journey import Goal, Journey
from bringup.control.lookout import Doubt, Lookout
from bringup.control.movers import LOST, Mover, followed, without
from bringup.control.outcome import Outcome
from bringup.control.passing import among, meeting
from bringup.control.route import found
from bringup.control.settings import Settings
from bringup.control.sight import Sight
from bringup.control.travelling import travelled
from bringup.control.way import Way
from tests.bringup.control.test_flat_world import Array, Robot, box, drive

RADIUS = 0.32
NOTHING = np.empty((0, 2))
EYE = Pose(0.0, 0.0, 0.0)


def lane(width: float) -> Array:
    return np.array(box(0.0, 0.0, 10.0, width))


def meet(sides: Array, half: float, seeds: tuple[int, int], seconds: float) -> tuple[float, list[Robot]]:
    """Two robots swap their places at x = -half and half."""
    robots = [
        Robot(-half, 0.05, 0.0, Settings(mode="go_to_goal", seed=seeds[0])),
        Robot(half, -0.05, math.pi, Settings(mode="go_to_goal", seed=seeds[1])),
    ]
    for robot in robots:
        robot.state = replace(robot.state, journey=Journey(Goal(-robot.x, 0.0), 0.0))
    return drive(sides, robots, seconds, seed=1), robots


def results(robots: list[Robot]) -> list[Outcome | None]:
    journeys = [robot.state.journey for robot in robots]
    return [None if each is None or each.result is None else each.result.outcome for each in journeys]


def test_two_robots_that_meet_head_on_pass_each_other() -> None:
    least, robots = meet(lane(1.9), 2.5, (1, 2), seconds=18.0)
    assert results(robots) == [Outcome.REACHED] * 2
    assert least > 0.0


def thing(x: float, y: float) -> Array:
    """The side of something round that is seen from the origin."""
    angles = math.atan2(y, x) + math.pi + np.linspace(-1.2, 1.2, 7)
    return np.column_stack((x + 0.15 * np.cos(angles), y + 0.15 * np.sin(angles)))


def free() -> Grid:
    """Nothing within 4 m, seen for a second."""
    angles = np.linspace(-math.pi, math.pi, 360)
    ends = 4.0 * np.column_stack((np.cos(angles), np.sin(angles)))
    grid = about(ends, 0.05)
    for _ in range(10):
        grid = marked(grid, EYE, NOTHING, ends)
    return grid


def test_what_comes_to_where_nothing_was_moves_and_stays_a_mover_when_it_stands() -> None:
    grid = free()
    movers: tuple[Mover, ...] = ()
    for step in range(60):
        x, now = max(1.0, 3.0 - 0.05 * step), 0.1 * step
        points = thing(x, 0.2)
        before, movers = movers, followed(movers, grid, EYE, points, now)
        grid = without(marked(grid, EYE, points, NOTHING), movers, before)
        if step == 30:
            assert movers[0].vx == pytest.approx(-0.5, abs=0.05)
    assert len(movers) == 1
    assert (movers[0].x, movers[0].y) == pytest.approx((1.0, 0.2), abs=0.1)
    assert movers[0].vx == pytest.approx(0.0, abs=0.1)
    assert not grid.occupied.any()
    assert followed(movers, grid, EYE, NOTHING, 5.9 + LOST / 2) == movers
    assert followed(movers, grid, EYE, NOTHING, 5.9 + LOST) == ()


def test_what_stood_there_from_the_start_does_not_move() -> None:
    grid = marked(about(thing(2.0, 0.0), 0.05), EYE, thing(2.0, 0.0), NOTHING)
    movers: tuple[Mover, ...] = ()
    for step in range(20):
        movers = followed(movers, grid, EYE, thing(2.0 + 0.02 * (step % 2), 0.0), 0.1 * step)
    assert [each.moves for each in movers] == [False]
    assert told_apart(Courtesy(), movers) == ((), ())


def test_what_stood_there_and_creeps_off_is_noticed() -> None:
    grid = marked(free(), EYE, np.repeat(thing(2.0, 0.0), 8, axis=0), NOTHING)
    movers: tuple[Mover, ...] = ()
    for step in range(60):
        points = thing(2.0 - 0.012 * step, 0.0)
        before, movers = movers, followed(movers, grid, EYE, points, 0.1 * step)
        grid = without(marked(grid, EYE, points, NOTHING), movers, before)
    assert [each.moves for each in movers] == [True]
    assert not grid.occupied.any()


def test_what_turns_up_beside_a_wall_is_the_wall() -> None:
    wall = np.column_stack((np.full(80, 2.0), np.linspace(-2.0, 2.0, 80)))
    grid = marked(free(), EYE, np.repeat(wall, 8, axis=0), NOTHING)
    for _ in range(6):
        grid = marked(grid, EYE, wall, NOTHING)
    assert not any(each.moves for each in followed((), grid, EYE, wall[:4] - (0.1, 0.0), 1.0))


def mover(x: float, y: float, vx: float = 0.0, since: float = 0.0, number: int = 1) -> Mover:
    return Mover(x, y, vx, 0.0, 0.0, number, (x, y, since))


@pytest.mark.parametrize("speed", [0.0, -0.5])
def test_others_are_passed_on_the_right(speed: float) -> None:
    way = found(meeting(free(), (mover(1.5, 0.0, speed),), (), EYE, RADIUS), EYE, (3.0, 0.0), 0.08)
    assert way is not None
    assert way.corners[:, 1].min() < -0.4
    assert way.corners[:, 1].max() < 0.1


def test_who_drives_away_is_passed_on_either_side() -> None:
    goes, stands = (meeting(free(), (mover(1.5, 0.0, speed),), (), EYE, RADIUS) for speed in (0.3, 0.0))
    behind, ahead = np.array([1.0, 1.2]), np.array([2.0, 1.2])
    assert goes.between(behind, ahead) < stands.between(behind, ahead)
    assert goes.between(np.zeros(2), np.array([1.5, 0.0])) == CLOSED


def walled(half: float) -> Grid:
    """A lane along x, from y = -half to half, from x = -6 to 6."""
    grid = about(np.array([[-6.0, -1.5], [6.0, 1.5]]), 0.05)
    evidence = grid.evidence.copy()
    xs = np.arange(-6.0, 6.0, 0.05)
    for y in (-half, half):
        cells = grid.cells(np.column_stack((xs, np.full(len(xs), y))))
        evidence[cells[:, 0], cells[:, 1]] = 12
    return replace(grid, evidence=evidence)


def test_who_gives_way_goes_where_others_can_come_by() -> None:
    grid, others = walled(1.0), (mover(0.8, 0.0),)
    fixed = among(grid, (), RADIUS)
    priced = meeting(grid, others, (), EYE, RADIUS)
    giving = begun(Courtesy(), priced, fixed, EYE, others, 7.0).giving
    assert giving is not None
    assert giving.x < 0.0
    assert abs(giving.y) > 0.1
    # In a lane that is only wide enough for one there is no such place, and the robot stays.
    narrow = costs(walled(0.5), RADIUS)
    after = begun(Courtesy(), narrow, narrow, EYE, others, 7.0)
    assert after.giving is None
    assert after.times == 1


def test_patience_ends_only_while_nobody_moves() -> None:
    stands = moved_on(Courtesy(), EYE, 10.0)
    assert moved_on(stands, Pose(0.1, 0.0, 0.0), 11.0) == stands
    limit = patience(5, 0, PATIENCE)
    assert PATIENCE[0] <= limit <= PATIENCE[1]
    assert not is_impatient(stands, (mover(0.8, 0.0),), 5, 10.0 + limit - 0.1, waits=True)
    assert is_impatient(stands, (mover(0.8, 0.0),), 5, 10.0 + limit + 0.1, waits=True)
    assert not is_impatient(stands, (mover(0.8, 0.0),), 5, 10.0 + limit + 0.1, waits=False)
    assert not is_impatient(stands, (mover(0.8, 0.0, since=12.0),), 5, 10.0 + limit + 0.1, waits=True)
    assert not is_impatient(stands, (), 5, 100.0, waits=True)
    assert patience(5, 0, PATIENCE) != patience(6, 0, PATIENCE)


def test_a_robot_goes_on_when_others_have_passed_or_do_not_come() -> None:
    way = Way(np.array([[3.0, 0.0]]), among(walled(1.0), (), RADIUS))
    waits = Courtesy(times=1, giving=Giving(0.0, 0.0, since=10.0))
    there, passed = (mover(1.5, 0.2, since=10.0),), (mover(-1.5, 0.2, since=10.0),)
    soon = 10.0 + SHORTEST + 0.1
    assert not is_over(waits, there, way, EYE, 5, soon)
    assert is_over(waits, passed, way, EYE, 5, soon)
    assert is_over(waits, there, way, EYE, 5, 10.1 + patience(5, 1, PATIENCE))
    moves = (mover(1.5, 0.2, since=10.0 + LONGEST),)
    assert not is_over(waits, moves, way, EYE, 5, 9.9 + LONGEST)
    assert is_over(waits, moves, way, EYE, 5, 10.1 + LONGEST)


def test_who_does_not_move_although_it_is_given_way_is_parked() -> None:
    waits = Courtesy(times=1, giving=Giving(0.0, 0.0, since=10.0))
    stays, moves = mover(1.5, 0.2, since=0.0), mover(2.5, 0.2, since=15.0, number=2)
    after = finished(waits, (stays, moves), PARKED + 1.0)
    assert after.giving is None
    assert told_apart(after, (stays, moves)) == ((moves,), (stays,))


@pytest.mark.parametrize("now", [95.0, 5.0], ids=["to the way before", "to before the goal"])
def test_a_clock_that_is_set_back_lets_nobody_wait_for_its_old_time(now: float) -> None:
    way = Way(np.array([[1.0, 1.0]]), costs(free(), RADIUS))
    waiting = Courtesy(1, 98.0, (0.0, 0.0, 98.0), Giving(0.0, 0.0, since=99.0), ((3.0, 3.0),))
    looking = Lookout(((3.0, 0.0),), Doubt(1.0, 1.0, way, since=99.0))
    there = Mover(1.0, 2.0, 0.0, 0.0, 100.0, 1, (1.0, 2.0, 98.0))
    journey = Journey(
        Goal(2.0, 0.0), 90.0, free(), (there,), 100.0, way, 100.0, lookout=looking, courtesy=waiting
    )
    sight = Sight(now + 0.1, NOTHING, EYE, NOTHING)
    after, command = travelled(journey, EYE, sight, Settings(mode="go_to_goal"), now + 0.1, STANDSTILL)
    assert after.way is not None
    assert after.way.corners[-1] == pytest.approx((2.0, 0.0), abs=0.1)
    assert command.linear > 0.0
    assert (after.courtesy.times, after.courtesy.parked) == (1, ((3.0, 3.0),))
    assert after.lookout.shut == ((3.0, 0.0),)
