"""What is set for all nodes again and again does not grow with how often it is, and counts as if all of it were there."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Process

_TIMES = 80
_MOST = 64


def _node(folder: Path, *actions: str) -> Process:
    """Return the node at the end of a launch file."""
    lines = "".join(f"- {action}\n" for action in actions)
    (folder / "late.yaml").write_text("n: {ros__parameters: {p: late}}")
    found = outcome(folder, f"launch:\n{lines}- node: {{exec: /bin/true, name: n}}")
    assert not found.problems.errors
    return found.plan.processes[0]


def test_of_a_variable_the_last_values_are_kept(tmp_path: Path) -> None:
    node = _node(tmp_path, *(f"set_env: {{name: V, value: v{time}}}" for time in range(_TIMES)))
    written = node.provenance.environment["V"]
    assert node.environment["V"] == f"v{_TIMES - 1}"
    assert [item.value for item in written] == [f"v{time}" for time in range(_TIMES - _MOST, _TIMES)]
    assert [item.won for item in written] == [False] * (_MOST - 1) + [True]


def test_of_a_parameter_the_first_and_the_last_values_are_kept(tmp_path: Path) -> None:
    node = _node(tmp_path, *(f"set_parameter: {{name: p, value: v{time}}}" for time in range(_TIMES)))
    written = node.provenance.parameters["p"]
    assert node.parameters["p"] == f"v{_TIMES - 1}"
    assert [item.value for item in written] == [
        "v0",
        *(f"v{time}" for time in range(_TIMES - _MOST + 1, _TIMES)),
    ]


def test_a_pattern_keeps_its_place_among_others(tmp_path: Path) -> None:
    """All values for every node come before a section that stood behind the first of them, however many there are."""
    later = (f"set_parameter: {{name: p, value: v{time}}}" for time in range(_TIMES))
    file = "set_parameters_from_file: {filename: late.yaml}"
    assert _node(tmp_path, "set_parameter: {name: p, value: a}", file, *later).parameters["p"] == "late"
    later = (f"set_parameter: {{name: p, value: v{time}}}" for time in range(_TIMES))
    assert _node(tmp_path, file, *later).parameters["p"] == f"v{_TIMES - 1}"


def test_a_rule_that_could_not_act_is_not_added_for_ever(tmp_path: Path) -> None:
    same = ["set_remap: {from: scan, to: /scan}"] * _TIMES
    node = _node(tmp_path, *same, "set_remap: {from: odom, to: /odom}")
    assert list(node.remappings) == [("scan", "/scan")] * _MOST + [("odom", "/odom")]


def test_parameters_of_many_names_are_all_kept(tmp_path: Path) -> None:
    actions = (f"set_parameter: {{name: p{time % 70}, value: {time}}}" for time in range(140))
    assert _node(tmp_path, *actions).parameters == {f"p{time - 70}": time for time in range(70, 140)}
