"""Parameters of well-known nodes, whose packages say nothing of them: told in launch files and in parameter files."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from tests.plan.checks.told import told

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
