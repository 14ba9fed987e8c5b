"""`for` and `for_each` of newer ROS releases, with the values that their turns have."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from tests.load.planning import planned
from tests.load.written import WRITERS, Actions

if TYPE_CHECKING:
    from pathlib import Path

both = pytest.mark.parametrize("language", sorted(WRITERS))


def _log(message: str) -> dict[str, Any]:
    return {"log": {"message": message}}


def _for(length: str, name: str, *children: dict[str, Any]) -> dict[str, Any]:
    return {"for": {"len": length, "name": name, "children": list(children)}}


def _for_each(values: str, *children: dict[str, Any]) -> dict[str, Any]:
    return {"for_each": {"values": values, "children": list(children)}}


_TURNS: dict[str, tuple[Actions, list[str]]] = {
    "an index counts from 0": ([_for("3", "i", _log("$(index i)"))], ["0", "1", "2"]),
    "the number comes from an argument": (
        [{"arg": {"name": "n", "default": "2"}}, _for("$(var n)", "i", _log("robot$(eval $(index i)+1)"))],
        ["robot1", "robot2"],
    ),
    "none at all": ([_for("0", "i", _log("$(index i)"))], []),
    "less than none": ([_for("-1", "i", _log("$(index i)"))], []),
    "one in another": (
        [_for("2", "i", _for("$(eval $(index i)+1)", "j", _log("$(index i)$(index j)")))],
        ["00", "10", "11"],
    ),
    "an inner index hides an outer one of its name, and ends": (
        [_for("2", "i", _for("1", "i", _log("in $(index i)")), _log("out $(index i)"))],
        ["in 0", "out 0", "in 0", "out 1"],
    ),
    "what is set in a turn stays set": (
        [_for("3", "i", {"let": {"name": "last", "value": "$(index i)"}}), _log("$(var last)")],
        ["2"],
    ),
    "mappings with semicolons between them": (
        [_for_each("{name: 'a', id: 1};{name: 'b', id: 2}", _log("$(for-var name) $(for-var id)"))],
        ["a 1", "b 2"],
    ),
    "a default where a mapping lacks a key": (
        [_for_each("{a: x};{}", _log("$(for-var a none)"))],
        ["x", "none"],
    ),
    "values as Python writes them": ([_for_each("{a: true, b: 1.50}", _log("$(for-var a) $(for-var b)"))], ["True 1.5"]),
    "nothing between semicolons": ([_for_each(";{a: x};;null;", _log("$(for-var a)"))], ["x"]),
    "no mapping at all": ([_for_each("", _log("$(for-var a)"))], []),
    "in a group, which has a key of that name": (
        [{"group": {"children": [_for_each("{a: x};{a: y}", _log("$(for-var a)"))]}}],
        ["x", "y"],
    ),
    "in a group that is repeated": (
        [
            {
                "group": {
                    "for_each": {"side": ["l", "r"]},
                    "children": [_for_each("{a: x};{a: y}", _log("$(var side)$(for-var a)"))],
                }
            }
        ],
        ["lx", "ly", "rx", "ry"],
    ),
    "a condition on the loop": (
        [{"for": {"len": "2", "name": "i", "if": "false", "children": [_log("a")]}}],
        [],
    ),
    "a condition in the loop": (
        [_for("3", "i", {"log": {"message": "$(index i)", "unless": "$(equals $(index i) 1)"}})],
        ["0", "2"],
    ),
}  # fmt: skip


@both
@pytest.mark.parametrize("case", _TURNS)
def test_turns_are_carried_out(case: str, language: str, tmp_path: Path) -> None:
    actions, messages = _TURNS[case]
    plan = planned(tmp_path, language, actions, {})
    assert plan.problems == ()
    assert plan.messages == messages


_BAD, _UNSET = "ORC010", "ORC020"
_FAULTS: dict[str, tuple[Actions, str]] = {
    "no number": ([_for("two", "i", _log("$(index i)"))], _BAD),
    "no whole number": ([_for("1.5", "i", _log("$(index i)"))], _BAD),
    "no mapping": ([_for_each("[a, b]", _log("$(for-var a)"))], _BAD),
    "no YAML": ([_for_each("{a: ", _log("$(for-var a)"))], _BAD),
    "another index": ([_for("1", "robot", _log("$(index robt)"))], _UNSET),
    "no loop": ([_log("$(index i)")], _UNSET),
    "behind the loop": ([_for("1", "i", _log("$(index i)")), _log("$(index i)")], _UNSET),
    "how often is not known": ([_for("$(var n)", "i", _log("$(index i) $(index j)"))], _UNSET),
}


@both
@pytest.mark.parametrize("case", _FAULTS)
def test_a_fault_is_told_once(case: str, language: str, tmp_path: Path) -> None:
    actions, code = _FAULTS[case]
    assert planned(tmp_path, language, actions, {}).problems == ((code, "error"),)
