"""The arbiter's parameters: what is meant by them, and which sets of them are refused and why."""

from pathlib import Path
from typing import Any

import pytest
import yaml

import bringup
from bringup.arbiter.settings import SettingsError, Source, settings, unknown

ONE = {"topics.a.topic": "x", "topics.a.priority": 1, "topics.a.timeout": 0.5}
OTHER = {"topics.b.topic": "y", "topics.b.priority": 2, "topics.b.timeout": 0.5}
LOCK = {"locks.l.topic": "z", "locks.l.priority": 255, "locks.l.timeout": 0.0}


def flat(values: dict[str, Any], before: str = "") -> dict[str, Any]:
    found: dict[str, Any] = {}
    for name, value in values.items():
        found |= flat(value, f"{before}{name}.") if isinstance(value, dict) else {before + name: value}
    return found


def test_inputs_and_locks_are_found_by_their_names() -> None:
    made = settings(ONE | OTHER | LOCK)
    assert made.inputs == (Source("a", "x", 1, 0.5), Source("b", "y", 2, 0.5))
    assert made.locks == (Source("l", "z", 255, 0.0),)


def test_the_parameter_file_of_the_bringup_can_be_used_and_puts_teleoperation_over_autonomy() -> None:
    path = Path(bringup.__file__).parent / "params" / "command_arbiter.yaml"
    values = flat(yaml.safe_load(path.read_text())["/**/command_arbiter"]["ros__parameters"])
    assert values.pop("use_stamped") is False
    made = {each.name: each for each in settings(values).inputs}
    assert made["teleoperation"].priority > made["autonomy"].priority
    assert unknown(list(values)) == {}


@pytest.mark.parametrize(
    ("values", "reason"),
    [
        ({}, "no input: give topics.NAME.topic, topics.NAME.priority and topics.NAME.timeout"),
        (LOCK, "no input: give topics.NAME.topic, topics.NAME.priority and topics.NAME.timeout"),
        ({"topics.a.topic": "x", "topics.a.timeout": 0.5}, "topics.a.priority is missing"),
        (ONE | {"topics.a.topic": ""}, "topics.a.topic is missing"),
        (ONE | {"topics.a.timeout": 0.0}, "topics.a.timeout is 0, must be more than 0"),
        (ONE | {"topics.a.timeout": float("nan")}, "topics.a.timeout is nan, must lie in 0.0 .. 86400.0"),
        (ONE | {"topics.a.priority": 256}, "topics.a.priority is 256, must lie in 0 .. 255"),
        (ONE | {"topics.a.priority": True}, "topics.a.priority is True, must be of type int"),
        (ONE | OTHER | {"topics.b.topic": "x"}, "a and b have the same topic: x"),
        (ONE | OTHER | {"topics.b.priority": 1}, "a and b have the same priority: 1"),
    ],
)
def test_a_set_of_values_is_refused_with_its_reason(values: dict[str, Any], reason: str) -> None:
    with pytest.raises(SettingsError) as refused:
        settings(values)
    assert str(refused.value) == reason


def test_a_parameter_that_no_source_has_is_told_with_the_nearest() -> None:
    assert unknown(["topics.a.topic", "topics.a.timout", "lock.l.priority", "speed"]) == {
        "topics.a.timout": "topics.a.timeout",
        "lock.l.priority": "locks.l.priority",
        "speed": "",
    }
