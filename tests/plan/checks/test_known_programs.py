"""Arguments of well-known programs, and what nodes of Nav2 are given: told where it is a slip."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import pytest

from orchestra.errors import Code
from tests.plan.checks.told import told

if TYPE_CHECKING:
    from pathlib import Path

    from tests.plan.checks.told import Told

_TOLD: Final = {
    Code.BAD_VALUE,
    Code.REFUSED_VALUE,
    Code.UNKNOWN_DEPENDENCY,
    Code.UNMATCHED_SECTION,
}
_TRANSFORM: Final = "{pkg: tf2_ros, exec: static_transform_publisher, name: tf, args: %s}"
_SPAWNER: Final = '{pkg: controller_manager, exec: spawner, args: "%s"}'
_MANAGER: Final = (
    "{pkg: nav2_lifecycle_manager, exec: lifecycle_manager, name: m, param: [{name: node_names, value: [%s]}]}\n"
    "- node: {pkg: demo, exec: server, name: map_server}\n- node: {pkg: demo, exec: server, name: amcl}"
)
_ROBOT: Final = "{pkg: robot_state_publisher, exec: robot_state_publisher, param: [{name: robot_description, value: '%s'}]}"


@pytest.mark.parametrize(
    ("node", "words", "expected"),
    [
        (_TRANSFORM, "--x 1 --yaw -0.5 --frame-id a --child-frame-id b", []),
        (_TRANSFORM, "--x 1 --frame_id a --child-frame-id b", [(Code.BAD_VALUE, "--frame_id", "--frame-id")]),
        (_TRANSFORM, "--x 1 --frame-id a --child-frame-id", [(Code.BAD_VALUE, "--child-frame-id", None)]),
        (_TRANSFORM, "--x 1 --frame-id a--child-frame-id b", []),
        (_TRANSFORM, "--x one --frame-id a --child-frame-id b", [(Code.BAD_VALUE, "one", None)]),
        (_TRANSFORM, "--x 1 --frame-id a", [(Code.BAD_VALUE, "--x", None)]),
        (_TRANSFORM, "0 0 0.1 0 0 0 base laser", []),
        (_TRANSFORM, "0 0 0.1 0 0 0 1 base laser --ros-args -r a:=b", []),
        (_TRANSFORM, "0 0 0.1 0 0 0 base laser 100", [(Code.BAD_VALUE, "100", None)]),
        (_TRANSFORM, "0 0 0.1 base laser", [(Code.BAD_VALUE, "0 0 0.1 base laser", None)]),
        (_TRANSFORM, "0 0 0.1 0 0 base laser 0", [(Code.BAD_VALUE, "base", None)]),
        (_SPAWNER, "joints --controller-manager /manager -p a.yaml --param=b.yaml", []),
        (_SPAWNER, "joints --controler-manager /m", [(Code.BAD_VALUE, "--controler-manager", "--controller-manager")]),
        (_SPAWNER, "joints --of-a-newer-release", []),
        (_MANAGER, "map_server, amcl, planner_server", []),
        (_MANAGER, "map_sever, amcl", [(Code.UNKNOWN_DEPENDENCY, "map_sever", "map_server")]),
        (_ROBOT, '<robot name="a"/>', []),
        (_ROBOT, "/robots/a.urdf.xacro", [(Code.REFUSED_VALUE, "/robots/a.urdf.xacro", None)]),
    ],
)  # fmt: skip
def test_what_a_known_program_cannot_read_is_told(
    node: str, words: str, expected: list[Told], tmp_path: Path
) -> None:
    found = told(tmp_path, f"- node: {node % words}\n")
    assert [(code, text.strip("'"), meant) for code, text, meant in found if code in _TOLD] == expected


_COSTMAPS: Final = """\
controller_server:
  ros__parameters: {controller_frequency: 20.0}
local_costmap:
  ros__parameters:
    update_frequency: 5.0
global_costmap:
  global_costmap:
    ros__parameters:
      update_frequency: 1.0
"""


def test_a_costmap_stands_below_its_namespace(tmp_path: Path) -> None:
    written = "launch:\n- node: {pkg: nav2_controller, exec: controller_server, name: controller_server, param: [{from: p.yaml}]}\n"
    found = told(tmp_path, {"main.launch.yaml": written, "p.yaml": _COSTMAPS})
    assert [item for item in found if item[0] in _TOLD] == [(Code.UNMATCHED_SECTION, "local_costmap", None)]


def test_arguments_of_a_known_program_are_evaluated_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What fails in them is told once, and a command among them runs once."""
    (tmp_path / "count").write_text("#!/bin/sh\necho ran >> runs\necho 0\n", "utf-8")
    (tmp_path / "count").chmod(0o755)
    monkeypatch.chdir(tmp_path)
    command = "$(command ./count) 0 0 0 0 0 a b"
    assert not [item for item in told(tmp_path, f"- node: {_TRANSFORM % command}\n") if item[0] in _TOLD]
    assert (tmp_path / "runs").read_text("utf-8").split() == ["ran"]
    lacking = "$(env NOBODY_HAS_THIS) 0 0 0 0 0 a b"
    codes = [item[0] for item in told(tmp_path, f"- node: {_TRANSFORM % lacking}\n")]
    assert codes.count(Code.UNSET_ENVIRONMENT) == 1
