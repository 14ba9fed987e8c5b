"""Nodes of one program are given a parameter with values of one type."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code
from tests.plan.checks.told import Told, told

if TYPE_CHECKING:
    from pathlib import Path


def _nodes(*values: str, programs: tuple[str, ...] = ("talker",)) -> str:
    return "".join(
        f"- node: {{pkg: demo, exec: {programs[place % len(programs)]}, name: n{place}, param: [{value}]}}\n"
        for place, value in enumerate(values)
    )


_CODE = Code.DECLARED_TYPE
UNLIKE: dict[str, tuple[str, list[Told]]] = {
    "an integer beside a float": (
        _nodes("{name: rate, value: 10.5}", "{name: rate, value: 10}", "{name: rate, value: 20.0}"),
        [(_CODE, "10", "10.0")],
    ),
    "an integer before a float, in a file": (
        _nodes("{from: p.yaml}", "{name: rate, value: 10.0}"),
        [(_CODE, "7", "7.0")],
    ),
    "a number in quotes": (
        _nodes("{name: rate, value: 10}", "{from: q.yaml}"),
        [(_CODE, '"7"', "7")],
    ),
    "a file for two nodes, told once": (
        _nodes("{from: p.yaml}", "{from: p.yaml}", "{name: rate, value: 1.0}"),
        [(_CODE, "7", "7.0")],
    ),
}
ALIKE = {
    "other programs": _nodes(
        "{name: rate, value: 10.0}", "{name: rate, value: 10}", programs=("talker", "listener")
    ),
    "a text that is no number": _nodes("{name: rate, value: 10.0}", "{name: rate, value: fast}"),
    "another parameter": _nodes("{name: rate, value: 10.0}", "{name: depth, value: 10}"),
    "a list": _nodes("{name: rate, value: 10.0}", "{name: rate, value: [10, 20]}"),
}


def _told(actions: str, folder: Path) -> list[Told]:
    files = {
        "p.yaml": "/**: {ros__parameters: {rate: 7}}\n",
        "q.yaml": '/**: {ros__parameters: {rate: "7"}}\n',
    }
    found = told(folder, {"main.launch.yaml": f"launch:\n{actions}", **files})
    return [item for item in found if item[0] is _CODE]


@pytest.mark.parametrize("case", UNLIKE)
def test_a_value_of_another_type_than_that_of_another_node_is_told(case: str, tmp_path: Path) -> None:
    actions, faults = UNLIKE[case]
    assert _told(actions, tmp_path) == faults


@pytest.mark.parametrize("case", ALIKE)
def test_what_may_well_be_another_type_is_left_alone(case: str, tmp_path: Path) -> None:
    assert _told(ALIKE[case], tmp_path) == []
