"""Timers, and which clock they go by."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code
from orchestra.plan.reactions import LogAction
from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from pathlib import Path

_TIMER = "- ros_timer: {period: 1.5, children: [{log: {message: hi, level: warning}}]}\n"


@pytest.mark.conforms("1.12 ROSTimer", "D58")
def test_a_timer_on_ros_time_is_a_timer(tmp_path: Path) -> None:
    found = outcome(tmp_path, f"launch:\n{_TIMER}")
    assert list(found.problems) == []
    (trigger,) = found.plan.triggers
    assert trigger.delay == 1.5
    (action,) = trigger.do
    assert isinstance(action, LogAction)
    assert (action.message, action.level) == ("hi", "warning")


@pytest.mark.conforms("1.12 SetUseSimTime", "D58")
@pytest.mark.parametrize(
    ("before", "told"),
    [
        ("- set_use_sim_time: {value: true}\n", True),
        ("- set_use_sim_time: {value: 'true'}\n", True),
        ("- set_use_sim_time: {value: $(not true)}\n", False),
        ("- set_use_sim_time: {value: true}\n- set_use_sim_time: {value: false}\n", False),
        ("- group: [{set_use_sim_time: {value: true}}, {node: {exec: a}}]\n", True),
    ],
)
def test_simulated_time_is_none_of_its_clocks(before: str, told: bool, tmp_path: Path) -> None:
    found = outcome(tmp_path, f"launch:\n{before}{_TIMER}")
    assert [code for code, *_ in found.faults] == ([Code.BAD_VALUE] if told else [])
    assert not found.problems.errors
    assert len(found.plan.triggers) == 1


def test_a_level_is_one_of_four_words(tmp_path: Path) -> None:
    found = outcome(tmp_path, "launch:\n- log: {message: hi, level: fatal}")
    assert [code for code, *_ in found.faults] == [Code.WRONG_TYPE]
    found = outcome(tmp_path, "launch:\n- log: {message: hi, level: $(var l warn)}")
    assert [code for code, *_ in found.faults] == [Code.BAD_VALUE]
