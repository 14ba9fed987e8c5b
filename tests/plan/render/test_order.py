"""A script starts each process behind those that it waits for, and takes a work in proportion to write."""

from __future__ import annotations

import cProfile
import pstats
from typing import TYPE_CHECKING

from hypothesis import given
from hypothesis import strategies as st

from orchestra.plan.conditions import Dependency
from orchestra.plan.render.shell import script
from orchestra.plan.render.shell.order import in_order
from tests.plan.records import at, plan, process

if TYPE_CHECKING:
    from orchestra.plan.model import Plan

_MOST = 8


def _plan(waits: list[set[int]]) -> Plan:
    edges = [tuple(Dependency(f"p{other}", "started", None, at(1)) for other in others) for others in waits]
    return plan(*(process(f"p{place}", "true", depends_on=each) for place, each in enumerate(edges)))


@given(st.lists(st.sets(st.integers(0, _MOST), max_size=3), max_size=_MOST))
def test_each_round_has_what_waits_for_no_other_in_the_order_of_the_plan(waits: list[set[int]]) -> None:
    """What waits for itself, however far around, comes last; a process that is not in the plan is not waited for."""
    left, expected = list(range(len(waits))), list[str]()
    while left:
        free = [place for place in left if waits[place].isdisjoint(left)] or left
        expected += [f"p{place}" for place in free]
        left = [place for place in left if place not in free]
    assert [item.id for item in in_order(_plan(waits))] == expected


def _calls(count: int) -> int:
    chain = _plan([{place - 1} - {-1} for place in range(count)])
    profile = cProfile.Profile()
    profile.enable()
    script.render(chain)
    profile.disable()
    total: int = pstats.Stats(profile).total_calls  # type: ignore[attr-defined] # typeshed does not know it
    return total


def test_twice_the_processes_take_twice_the_work() -> None:
    _calls(5)
    once, twice = _calls(100), _calls(200)
    assert twice < 2.1 * once
