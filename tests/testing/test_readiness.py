"""When a process of a run counts as up, and when waiting for it is in vain."""

from __future__ import annotations

from dataclasses import replace

import pytest

from orchestra.events import Event, Kind
from orchestra.location import Location, point
from orchestra.plan.conditions import Ready
from orchestra.plan.model import VERSION, Plan
from orchestra.plan.reactions import StartAction, Trigger, TriggerEvent
from orchestra.testing.readiness import identity, standing
from tests.supervise.plans import process as described

_HERE = Location(point("x.yaml"))
_PLAIN = described("/plain", kind="node")
_AWAITED = replace(_PLAIN, id="/awaited", ready=Ready(log="up", message=None, timeout=None))
_LATER = replace(_PLAIN, id="/later")
_START_LATER = Trigger(
    "t1", TriggerEvent("run_started"), (StartAction("/later", _HERE),), 5.0, deferred=False, location=_HERE
)
_PLAN = Plan(
    VERSION,
    "x.yaml",
    arguments=(),
    processes=(_PLAIN, _AWAITED, _LATER),
    components=(),
    triggers=(
        Trigger(
            "t1",
            TriggerEvent("run_started"),
            (StartAction("/later", _HERE),),
            5.0,
            deferred=False,
            location=_HERE,
        ),
    ),
    skipped=(),
    problems=(),
)


def _event(kind: Kind, process: str) -> Event:
    return Event(0.0, 0.0, kind, process, cause="so it is")


@pytest.mark.parametrize(
    ("happened", "names", "pending", "lost"),
    [
        ([], (), ("/plain", "/awaited"), 0),  # what a trigger starts is not waited for
        ([], ("later",), ("/later",), 0),  # unless it is named
        ([("process_running", "/plain"), ("process_running", "/awaited")], (), ("/awaited",), 0),
        ([("process_running", "/plain"), ("process_ready", "/awaited")], (), (), 0),
        ([("process_exited", "/plain")], ("plain",), (), 0),  # it has been up
        ([("process_exited", "/awaited")], ("awaited",), ("/awaited",), 0),
        ([("process_failed", "/awaited")], (), ("/plain", "/awaited"), 1),
        ([("process_skipped", "/awaited")], ("/awaited",), ("/awaited",), 1),
        ([("process_failed", "/awaited")], ("plain",), ("/plain",), 0),  # nobody asked about it
        ([("process_ready", "/awaited"), ("process_failed", "/awaited")], ("awaited",), (), 0),
    ],
)
def test_standing(
    happened: list[tuple[Kind, str]], names: tuple[str, ...], pending: tuple[str, ...], lost: int
) -> None:
    now = standing(_PLAN, [_event(*item) for item in happened], names)
    assert now.pending == pending
    assert len(now.lost) == lost


def test_a_process_is_named_with_or_without_its_slash() -> None:
    assert identity(_PLAN, "plain") == identity(_PLAN, "/plain") == "/plain"


def test_a_name_that_is_not_in_the_plan_is_refused_with_a_hint() -> None:
    with pytest.raises(LookupError, match="did you mean /plain"):
        identity(_PLAN, "plian")
