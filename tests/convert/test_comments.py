"""Comments stay with what they stand with."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.convert.converting import ENDINGS, convert
from tests.convert.turning import turned

if TYPE_CHECKING:
    from pathlib import Path

_YAML = """\
# yaml-language-server: $schema=../schemas/launch.schema.json
# Copyright of somebody
#
# Licence

# What the file is for -- in short
launch:
  # which world
  - arg: {name: world, default: arena}  # arena or maze
  - node:  # the simulation
      pkg: bringup
      # the program
      exec: simulation
      param:
        # how fast
        - name: speed
          value: '1 # 2'  # no comment in quotes
      remap:   # rules
        - {from: a, to: b}
  # - node: {pkg: old}
  - group:
      # inside
      - log:
          message: |
            # no comment
            either
  - log: {message: end}
# at the end
"""

_XML = """\
<?xml version="1.0"?>
<!--
  Copyright of somebody

  Licence

  What the file is for - - in short
-->
<launch>
  <!-- which world -->
  <arg name="world" default="arena"/>  <!-- arena or maze -->
  <!-- the program -->
  <node pkg="bringup" exec="simulation">  <!-- the simulation -->
    <!-- how fast -->
    <!-- no comment in quotes -->
    <param name="speed" value="'1 # 2'"/>
    <!-- rules -->
    <remap from="a" to="b"/>
  </node>
  <!-- - node: {pkg: old} -->
  <group>
    <!-- inside -->
    <log message="# no comment&#10;either&#10;"/>
  </group>
  <log message="end"/>
</launch>
<!-- at the end -->
"""

_PYTHON = """\
# Copyright of somebody
#
# Licence
#
# What the file is for -- in short

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction, LogInfo
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            # which world
            DeclareLaunchArgument("world", default_value="arena"),  # arena or maze
            Node(  # the simulation
                package="bringup",
                # the program
                executable="simulation",
                parameters=[
                    {
                        # how fast
                        "speed": "1 # 2",  # no comment in quotes
                    },
                ],
                remappings=[
                    # rules
                    ("a", "b"),
                ],
            ),
            # - node: {pkg: old}
            GroupAction(
                actions=[
                    # inside
                    LogInfo(msg="# no comment\\neither\\n"),
                ],
            ),
            LogInfo(msg="end"),
        ],
    )
    # at the end
"""

_AGAIN = """\
# Copyright of somebody
#
# Licence
#
# What the file is for -- in short

launch:
  # which world
  - arg:  # arena or maze
      name: world
      default: arena
  - node:  # the simulation
      pkg: bringup
      # the program
      exec: simulation
      param:
        # how fast
        - name: speed  # no comment in quotes
          value: '1 # 2'
      remap:
        # rules
        - from: a
          to: b
  # - node: {pkg: old}
  - group:
      children:
        # inside
        - log:
            message: |
              # no comment
              either
  - log:
      message: end
# at the end
"""


@pytest.mark.parametrize(
    ("text", "language", "expected"),
    [(_YAML, "xml", _XML), (_YAML, "python", _PYTHON), (_PYTHON, "yaml", _AGAIN)],
    ids=["yaml to xml", "yaml to python", "python to yaml"],
)
def test_comments_stay_with_what_they_stand_with(
    text: str, language: str, expected: str, tmp_path: Path
) -> None:
    ending = ENDINGS["python" if text == _PYTHON else "yaml"]
    path = tmp_path / f"a{ending}"
    path.write_text(text, "utf-8")
    assert turned(path, language, {"PATH": "/bin"}).read_text("utf-8") == expected


def test_no_comment_is_lost_on_the_way_round(tmp_path: Path) -> None:
    path = tmp_path / "a.launch.yaml"
    path.write_text(_YAML, "utf-8")
    there = path
    for language in ("xml", "python", "yaml", "python", "xml", "yaml"):
        there = turned(there, language, {"PATH": "/bin"}, f"to_{language}")
        text = there.read_text("utf-8")
        for comment in (
            "Licence",
            "which world",
            "arena or maze",
            "the simulation",
            "the program",
            "how fast",
        ):
            assert text.count(comment) == 1, (comment, text)
        for comment in ("no comment in quotes", "rules", "{pkg: old}", "inside", "at the end"):
            assert text.count(comment) == 1, (comment, text)


_CODE = '''\
#!/usr/bin/env python3
"""What the module says of itself.

In two paragraphs.
"""
# A licence
import os  # noqa: F401

from launch import LaunchDescription
from launch_ros.actions import Node


def made(name):
    # made by a function
    return Node(package="p", executable="e", name=name)  # made here


def generate_launch_description():
    nodes = [made(name) for name in ("a", "b")]
    # the last one
    last = Node(
        package="p",
        executable="last",
        name="last",
        # what it is told
        arguments=["-v"],
        parameters=[{"rate": 1.0}],  # its rate
    )
    return LaunchDescription([*nodes, last])  # all of them
'''


def test_comments_of_code_stand_with_what_it_makes_once(tmp_path: Path) -> None:
    path = tmp_path / "a.launch.py"
    path.write_text(_CODE, "utf-8")
    found = convert(str(path), "yaml", {"PATH": "/bin"})
    assert found.text is not None
    lines = [line.strip() for line in found.text.split("\n")]
    assert lines[:6] == [
        "# What the module says of itself.", "#", "# In two paragraphs.", "# A licence", "", "launch:",
    ]  # fmt: skip
    assert "noqa" not in found.text
    for before, after in [
        ("# made by a function", "- node:  # made here"),
        ("# the last one", "- node:"),
        ("# what it is told", "args: -v"),
        ("param:  # its rate", "- name: rate"),
    ]:
        assert lines.index(after, lines.index(before)) == lines.index(before) + 1
    assert found.text.count("made by a function") == 1
    assert lines[-2:] == ["# all of them", ""]
