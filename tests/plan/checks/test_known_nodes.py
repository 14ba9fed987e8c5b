"""Parameters of well-known nodes, whose packages say nothing of them: told in launch files and in parameter files."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code
from tests.plan.checks.told import told
from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from pathlib import Path

_LAUNCH = """\
launch:
- node:
    pkg: robot_localization
    exec: ekf_node
    name: ekf
    param: [{from: p.yaml}, {name: two_d_mode, value: 1}]
- node: {pkg: demo, exec: ekf_node, name: other, param: [{from: p.yaml}]}
"""
_FILE = """\
ekf:
  ros__parameters:
    frequency: 30
    acceleration_gains: [[0.8, 0.0], [0.0, 0.9]]
    odom0_cofnig: [true]
other:
  ros__parameters:
    frequency: 30
"""


def test_values_and_names_that_a_known_node_does_not_take_are_told(tmp_path: Path) -> None:
    """What is left of a value that could not be read is not told once more, and other nodes are left alone."""
    found = told(tmp_path, {"main.launch.yaml": _LAUNCH, "p.yaml": _FILE})
    codes = (Code.DECLARED_TYPE, Code.UNDECLARED_PARAMETER, Code.REFUSED_VALUE)
    assert [item for item in found if item[0] in codes] == [
        (Code.DECLARED_TYPE, "1", "true"),
        (Code.DECLARED_TYPE, "30", "30.0"),
        (Code.UNDECLARED_PARAMETER, "odom0_cofnig", "odom0_config"),
    ]


_WORLD = """\
launch:
- arg: {name: earth}
- node:
    pkg: robot_localization
    exec: ekf_node
    name: ekf
    param: [{name: world_frame, value: earth}, %s]
"""


@pytest.mark.parametrize(
    ("more", "expected"),
    [
        ("{name: frequency, value: 30.0}", [(Code.REFUSED_VALUE, "earth", "odom")]),
        ("{name: map_frame, value: $(var earth)}", []),
        ("{from: $(find-pkg-share not_here)/p.yaml}", []),
    ],
)
def test_a_frame_is_wrong_only_where_all_others_are_known(
    more: str, expected: list[tuple[Code, str, str]], tmp_path: Path
) -> None:
    found = told(tmp_path, {"main.launch.yaml": _WORLD % more})
    assert [item for item in found if item[0] is Code.REFUSED_VALUE] == expected


def test_it_is_told_from_where_a_parameter_is_known(tmp_path: Path) -> None:
    files = {"main.launch.yaml": _WORLD % "{name: frequency, value: 30}"}
    report = outcome(tmp_path, files, launching=False).problems.ordered
    notes = [problem.notes for problem in report if problem.code is Code.DECLARED_TYPE]
    assert notes == [
        (
            "so it is in the code of ekf_node of robot_localization (Humble to Jazzy); "
            "a comment with 'orchestra: ignore[ORC092]' silences it",
        )
    ]
