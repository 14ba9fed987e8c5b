"""Where a robot looks before it gives a goal up, and when it has looked enough."""

import numpy as np
import pytest

from bringup.control.command import Pose
from bringup.control.costs import Costs, costs, eased
from bringup.control.lookout import LOOK, Lookout, is_looking, looked
from bringup.control.route import found
from bringup.control.way import Way, is_free
from tests.bringup.control.test_route import RADIUS, drawn

# 3 x 3 m: a wall with a gap of 0.4 m, which the robot does not come through.
GAP = ("#" * 30 + "\n") + ("#" + "." * 14 + "#" + "." * 13 + "#\n") * 11
GAP += ("#" + "." * 28 + "#\n") * 4
GAP += ("#" + "." * 14 + "#" + "." * 13 + "#\n") * 13 + "#" * 30
WALLED = ("#" * 30 + "\n") + ("#" + "." * 14 + "#" + "." * 13 + "#\n") * 28 + "#" * 30
HERE, BEHIND, OUTSIDE = Pose(0.75, 1.55, 0.0), (2.35, 1.55), (3.8, 1.55)


def priced() -> Costs:
    grid = drawn(GAP)
    evidence = np.pad(grid.evidence, ((15, 15), (15, 15)))
    return costs(type(grid)(grid.resolution, -15, -15, evidence), RADIUS)


def end(way: Way) -> Pose:
    x, y = way.corners[-1].tolist()
    return Pose(x, y, 0.0)


def test_a_place_behind_a_gap_that_seems_too_narrow_is_looked_at_from_near() -> None:
    assert found(priced(), HERE, BEHIND, 0.08) is None
    doubt = looked(Lookout(), priced(), HERE, BEHIND, 0.0).doubt
    assert doubt is not None
    assert doubt.since is None
    assert (doubt.x, doubt.y) == pytest.approx((1.3, 1.5), abs=0.15)
    assert is_free(doubt.way, HERE)
    assert doubt.way.corners[-1][0] < doubt.x


def test_what_stays_shut_while_the_robot_looks_is_shut() -> None:
    looks = looked(Lookout(), priced(), HERE, BEHIND, 0.0)
    assert not is_looking(looks)
    assert looks.doubt is not None
    there = end(looks.doubt.way)
    for seconds in (0.0, LOOK):
        looks = looked(looks, priced(), there, BEHIND, 10.0 + seconds)
        assert is_looking(looks)
    after = looked(looks, priced(), there, BEHIND, 10.1 + LOOK)
    assert after.doubt is None
    assert len(after.shut) == 1


def test_a_place_that_closes_on_the_way_to_it_is_not_gone_to_again() -> None:
    looks = looked(Lookout(), priced(), HERE, BEHIND, 0.0)
    closed = costs(drawn(WALLED), RADIUS)
    after = looked(looks, closed, HERE, BEHIND, 1.0)
    assert after.doubt is None
    assert looked(after, priced(), HERE, BEHIND, 2.0).doubt is None


def test_where_walls_are_closed_there_is_nothing_to_look_at() -> None:
    assert looked(Lookout(), priced(), HERE, OUTSIDE, 0.0) == Lookout()


def test_who_has_looked_from_one_side_of_a_wall_does_not_go_to_look_from_the_other() -> None:
    inside = (1.55, 0.45)
    now, lookout, pose = 0.0, Lookout(), HERE
    for _ in range(20):
        lookout = looked(lookout, priced(), pose, inside, now)
        if lookout.doubt is None:
            break
        assert lookout.doubt.x < inside[0]
        pose, now = end(lookout.doubt.way), now + 1.0
    assert lookout.doubt is None
    assert inside in lookout.shut


def test_at_its_goal_a_robot_may_come_as_near_to_something_as_the_guard_lets_it() -> None:
    place = (0.35, 0.75)
    tight = eased(priced(), 0.22, place, 0.2)
    assert found(priced(), HERE, place, 0.08) is None
    assert tight is not None
    way = found(tight, HERE, place, 0.08)
    assert way is not None
    assert way.corners[-1].tolist() == pytest.approx(place)
    # Elsewhere as before: the gap stays closed, and in the open nothing is gained.
    assert eased(priced(), 0.22, (0.75, 1.55), 0.2) is None
    assert found(tight, HERE, BEHIND, 0.08) is None
