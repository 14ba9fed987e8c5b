"""Triggers that wait are found by event and target, in the order in which they began to wait."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hypothesis import given
from hypothesis import strategies as st

from orchestra.location import Location, Span
from orchestra.plan.reactions import Trigger, TriggerEvent
from orchestra.supervise.reactions.happening import Happening, matches
from orchestra.supervise.reactions.waiting import Waiting

if TYPE_CHECKING:
    from orchestra.values import EventName

EVENTS: tuple[EventName, ...] = ("process_started", "process_exited")
PLACE = Location(Span("a.yaml", 1, 1, 1, 2))
TARGETS = (None, "/a", "/b")


def trigger(name: int) -> Trigger:
    """Return one of six, told apart by their number, two of which wait for the same."""
    on = TriggerEvent(EVENTS[name % 2], TARGETS[name % 3])
    return Trigger(str(name), on, (), None, deferred=False, location=PLACE)


@given(st.lists(st.tuples(st.booleans(), st.integers(0, 11)), max_size=40))
def test_it_finds_what_a_look_at_each_would_find(steps: list[tuple[bool, int]]) -> None:
    waiting, listed = Waiting(), dict[str, Trigger]()
    for begins, name in steps:
        listed.pop(str(name), None)
        if begins:
            listed[str(name)] = trigger(name)
            waiting.add(trigger(name))
        else:
            waiting.remove(str(name))
    for event in EVENTS:
        assert waiting.has(event) or not any(one.on.event == event for one in listed.values())
        for target in TARGETS:
            happening = Happening(event, target)
            assert waiting.about(happening) == [one for one in listed.values() if matches(one.on, happening)]
