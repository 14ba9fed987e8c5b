"""Goals that robots claim: never two nearer than they may be, whatever the order in which they come."""

from __future__ import annotations

from itertools import combinations, permutations

from hypothesis import given
from hypothesis import strategies as st

from bringup.fleet.claims import Claim, decided, lasting
from bringup.fleet.discovery import Presence
from bringup.fleet.frames import Place

_APART = 1.0
_coordinates = st.floats(-2.0, 2.0).map(lambda value: round(value, 1))
_places = st.builds(Place, st.sampled_from(["world", "elsewhere"]), _coordinates, _coordinates)
_claims = st.builds(Claim, st.sampled_from(["a", "b", "c"]), _places, st.integers(0, 2))


def _claim(robot: str, x: float, stamp: int = 0, frame: str = "world") -> Claim:
    return Claim(robot, Place(frame, x, 0.0), stamp)


@given(st.lists(st.lists(_claims, max_size=5), max_size=4))
def test_no_two_robots_hold_goals_that_are_too_near(batches: list[list[Claim]]) -> None:
    held: dict[str, Claim] = {}
    for batch in batches:
        held, answers = decided(held, batch, _APART)
        assert all(answer.granted or answer.distance < _APART for answer in answers)
        for one, other in combinations(held.values(), 2):
            distance = one.place.distance(other.place)
            assert distance is None or distance >= _APART


@given(st.lists(_claims, max_size=4))
def test_claims_that_come_together_are_decided_alike_in_every_order(batch: list[Claim]) -> None:
    results = []
    for order in permutations(batch):
        held, answers = decided({}, order, _APART)
        results.append((held, dict(zip(order, answers, strict=True))))
    assert all(result == results[0] for result in results)


def test_the_earliest_stamp_comes_first_and_then_the_name() -> None:
    held, answers = decided({}, [_claim("b", 0.0, 1), _claim("a", 0.1, 2), _claim("c", 0.2, 1)], _APART)
    assert set(held) == {"b"}
    assert [answer.holder for answer in answers] == ["", "b", "b"]


def test_what_is_granted_is_not_taken_away_by_an_earlier_stamp() -> None:
    held, _ = decided({}, [_claim("b", 0.0, 5)], _APART)
    after, answers = decided(held, [_claim("a", 0.1, 1)], _APART)
    assert after == held
    assert answers[0].distance == 0.1


def test_a_robot_moves_its_own_claim_and_keeps_it_where_it_is_refused_another() -> None:
    held, _ = decided({}, [_claim("a", 0.0), _claim("b", 3.0)], _APART)
    held, answers = decided(held, [_claim("a", 0.2)], _APART)
    assert answers[0].granted
    held, answers = decided(held, [_claim("a", 2.5)], _APART)
    assert answers[0].holder == "b"
    assert held["a"].place.x == 0.2


def test_goals_in_frames_without_a_way_between_them_are_granted_and_told() -> None:
    held, _ = decided({}, [_claim("a", 0.0, frame="a/odom")], _APART)
    _, answers = decided(held, [_claim("b", 0.0, frame="b/odom")], _APART)
    assert answers[0].granted
    assert answers[0].incomparable == ("a",)


def test_a_claim_ends_with_its_robot_or_with_its_controller() -> None:
    first, second = frozenset({"first"}), frozenset({"first", "second"})
    held = {"a": Claim("a", Place("world", 0.0, 0.0), 0, first)}
    assert lasting(held, {"a": Presence(driven=True, controllers=first)}) == held
    # A moment without a controller is none of another: it may only be late to be seen.
    assert lasting(held, {"a": Presence()}) == held
    assert lasting(held, {"a": Presence(driven=True, controllers=second)}) == {}
    assert lasting(held, {}) == {}
