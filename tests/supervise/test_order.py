from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.ending import Ending
from orchestra.supervise.life import Phase, Rules, State
from orchestra.supervise.order import Fate, Life, fate, patience, reached, stop_levels
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


def test_dependents_stop_before_what_they_depend_on() -> None:
    chain = [
        process("map"),
        process("filter", depends_on=after("map", "ready")),
        process("control", depends_on=after("filter", "ready") + after("map", "started")),
        process("alone"),
    ]
    assert stop_levels(chain) == {"control": 0, "alone": 0, "filter": 1, "map": 2}


@pytest.mark.parametrize(
    ("levels", "seconds"), [([], 1.0), ([0], 1.0), ([0, 1], 1.0), ([0, 1, 2, 3, 4], 0.5)]
)
def test_the_last_level_is_asked_in_time(levels: list[int], seconds: float) -> None:
    assert patience(levels) == seconds
