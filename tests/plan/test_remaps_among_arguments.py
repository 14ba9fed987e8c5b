"""Remapping rules among a node's own arguments come first, as they do for rcl."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.errors import Code, Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.remapping_order import rules_for

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Process


def _planned(folder: Path, node: str) -> tuple[Process, Problems]:
    path, problems = folder / "a.yaml", Problems()
    path.write_text(f"launch:\n  - node: {{exec: e, name: n, namespace: /ns, {node}}}\n")
    plan = collect(str(path), inputs_from((), environment=os.environ), problems)
    assert plan is not None
    return plan.processes[0], problems


def test_they_count_before_those_of_the_description(tmp_path: Path) -> None:
    words = (
        "args: -r no:=rule --ros-args -r scan:=/first -r __node:=n, ros_args: --remap rostopic://odom:=~/own"
    )
    described = "remap: [{from: scan, to: /second}, {from: imu, to: /imu}], ready: {message: scan}"
    process, problems = _planned(tmp_path, f"{words}, {described}")
    assert process.remappings == (
        ("scan", "/first"),
        ("rostopic://odom", "~/own"),
        ("scan", "/second"),
        ("imu", "/imu"),
    )
    assert [rules_for(process, name)[0].value for name in ("scan", "odom", "imu")] == [
        "/first",
        "/ns/n/own",
        "/imu",
    ]
    assert process.ready is not None
    assert process.ready.message == "/first"
    assert [
        (item.code, item.span and item.span.line) for item in problems if item.code is Code.DEAD_REMAP
    ] == [(Code.DEAD_REMAP, 2)]


def test_the_command_line_has_them_once(tmp_path: Path) -> None:
    process, _ = _planned(tmp_path, "ros_args: -r scan:=/first, remap: [{from: imu, to: /imu}]")
    assert process.command[1:4] == ("--ros-args", "-r", "scan:=/first")
    assert process.command[-2:] == ("-r", "imu:=/imu")
    assert process.command.count("scan:=/first") == 1


def test_a_rule_that_rcl_refuses_is_told(tmp_path: Path) -> None:
    _, problems = _planned(tmp_path, "ros_args: '-r scan:=1st'")
    assert [item.code for item in problems.errors] == [Code.BAD_NAME]
