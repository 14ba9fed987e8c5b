"""What the values of a Python launch file are told to be made of."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Problems
from orchestra.pipeline import collect, inputs_from

if TYPE_CHECKING:
    from pathlib import Path

_LOOP = """\
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

NAMES = ("first", "second", "third")


def generate_launch_description():
    declared = [DeclareLaunchArgument(name, default_value=f"{name} value") for name in NAMES]
    node = Node(executable="true", parameters=[{name: LaunchConfiguration(name) for name in NAMES}])
    return LaunchDescription([*declared, node])
"""


def test_values_of_one_place_are_each_told_what_was_read_for_them(tmp_path: Path) -> None:
    path = tmp_path / "loop.launch.py"
    path.write_text(_LOOP, "utf-8")
    plan = collect(str(path), inputs_from([], environment={"PATH": "/usr/bin:/bin"}), Problems())
    assert plan is not None
    told = plan.processes[0].provenance
    assert told is not None
    read = {name: [via.name for via in values[0].through] for name, values in told.parameters.items()}
    assert read == {"first": ["first"], "second": ["second"], "third": ["third"]}
