from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.supervise.process.ending import Ending
from orchestra.supervise.process.life import Phase, Rules, State
from orchestra.supervise.process.order import Fate, Life, fate, reached, schedule, stop_levels
from orchestra.supervise.process.rules import rules_of, stop_of
from orchestra.values import Stop
from tests.supervise.plans import after, process

if TYPE_CHECKING:
    from orchestra.values import Condition

GOOD, BAD = Ending(code=0), Ending(code=1)
STATES = {
    "waiting": State(Phase.WAITING),
    "starting": State(Phase.STARTING),
    "running": State(Phase.RUNNING, starts=1),
    "ready": State(Phase.READY, starts=1, been_ready=True),
    "restarting": State(Phase.RESTARTING, starts=1, ending=BAD),
    "restarting, ready before": State(Phase.RESTARTING, starts=1, been_ready=True, ending=BAD),
    "ended well": State(Phase.EXITED, starts=1, ending=GOOD),
    "ended well, ready before": State(Phase.EXITED, starts=1, been_ready=True, ending=GOOD),
    "failed": State(Phase.FAILED, starts=1, ending=BAD),
    "never started": State(Phase.FAILED, ending=Ending(code=127, reason="missing")),
    "skipped": State(Phase.SKIPPED),
}


@pytest.mark.parametrize(
    ("state", "started", "ready", "completed", "exited"),
    [
        ("waiting", None, None, None, None),
        ("starting", None, None, None, None),
        ("running", True, None, None, None),
        ("ready", True, True, None, None),
        ("restarting", True, None, None, None),
        ("restarting, ready before", True, True, None, None),
        ("ended well", True, False, True, True),
        ("ended well, ready before", True, True, True, True),
        ("failed", True, False, False, True),
        ("never started", False, False, False, True),
        ("skipped", False, False, False, False),
    ],
)
def test_when_each_condition_holds(
    state: str, started: bool | None, ready: bool | None, completed: bool | None, exited: bool | None
) -> None:
    life = Life(Rules(), STATES[state])
    conditions: tuple[Condition, ...] = ("started", "ready", "completed", "exited")
    assert [reached(condition, life) for condition in conditions] == [started, ready, completed, exited]


def test_a_process_begins_when_all_conditions_hold() -> None:
    lives = {"a": Life(Rules(), STATES["ready"]), "b": Life(Rules(), STATES["running"])}
    both = after("a", "ready") + after("b", "ready")
    assert fate(both, lives) == Fate(awaited=after("b", "ready"))
    lives["b"] = Life(Rules(), STATES["ready"])
    assert fate(both, lives) == Fate(begin=True)
    lives["a"] = Life(Rules(), STATES["failed"])
    assert fate(both, lives) == Fate(blocker=both[0])


def test_what_is_not_required_is_awaited_only_as_long_as_it_may_come() -> None:
    optional = tuple(replace(edge, required=False) for edge in after("a", "ready"))
    assert fate(optional, {"a": Life(Rules(), STATES["running"])}) == Fate(awaited=optional)
    for state in ("failed", "skipped", "ready"):
        assert fate(optional, {"a": Life(Rules(), STATES[state])}) == Fate(begin=True)


@pytest.mark.parametrize("state", ["ended well", "failed", "skipped"])
def test_what_an_operator_has_ended_may_be_started_again(state: str) -> None:
    life = Life(Rules(), replace(STATES[state], halted=True, been_ready=False))
    assert [reached(condition, life) for condition in ("ready", "completed")] == [None, None]


def test_dependents_stop_before_what_they_depend_on() -> None:
    chain = [
        process("map"),
        process("filter", depends_on=after("map", "ready")),
        process("control", depends_on=after("filter", "ready") + after("map", "started")),
        process("alone"),
    ]
    assert stop_levels(chain) == {"control": 0, "alone": 0, "filter": 1, "map": 2}


@pytest.mark.parametrize(
    ("levels", "asked"),
    [
        ([], (0.0,)),
        ([0], (0.0,)),
        ([0, 1], (0.0, 1.0)),
        ([0, 1, 2, 3, 4], (0.0, 0.5, 1.0, 1.5, 2.0)),
    ],
)
def test_the_last_level_is_asked_in_time(levels: list[int], asked: tuple[float, ...]) -> None:
    named = {str(index): level for index, level in enumerate(levels)}
    assert schedule(named, {}) == (asked, 5.0)


@pytest.mark.parametrize(
    ("stops", "asked", "deadline"),
    [
        ({"a": Stop(timeout=0.1, kill_timeout=0.1)}, (0.0, 1.0, 2.0), 5.0),
        ({"a": Stop(timeout=20.0, kill_timeout=1.0)}, (0.0, 20.0, 21.0), 25.0),
        ({"b": Stop(timeout=20.0, kill_timeout=1.0)}, (0.0, 1.0, 21.0), 25.0),
        ({"c": Stop(timeout=20.0, kill_timeout=10.0)}, (0.0, 1.0, 2.0), 32.5),
        ({"c": Stop(timeout=1.0, kill_timeout=0.5)}, (0.0, 1.0, 2.0), 5.0),
    ],
)
def test_who_asks_for_more_time_gets_it(
    stops: dict[str, Stop], asked: tuple[float, ...], deadline: float
) -> None:
    assert schedule({"a": 0, "b": 1, "c": 2}, stops) == (asked, deadline)


@pytest.mark.parametrize(
    ("fields", "stop", "quiesce_within", "whole"),
    [
        ({"lifecycle": "active"}, None, 1.5, None),
        ({"lifecycle": "active"}, Stop(timeout=0.5), 1.5, Stop(timeout=0.5)),
        ({"lifecycle": "active"}, Stop(timeout=20.0), 20.0, Stop(timeout=40.0)),
        ({"kind": "container"}, Stop("SIGTERM", 20.0, 3.0), 20.0, Stop("SIGTERM", 40.0, 3.0)),
        ({"kind": "node"}, Stop(timeout=20.0), 1.5, Stop(timeout=20.0)),
    ],
)
def test_more_time_to_end_is_more_time_to_deactivate_too(
    fields: dict[str, Any], stop: Stop | None, quiesce_within: float, whole: Stop | None
) -> None:
    given = process("a", stop=stop, **fields)
    assert rules_of(given).quiesce_within == quiesce_within
    assert stop_of(given) == whole
