"""The same description in three languages looks the same without being executed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.cli.glance.model import Glance, SeenArgument, SeenInclude

if TYPE_CHECKING:
    from tests.cli.glance.conftest import Look

_TEXTS = {
    "a.launch.yaml": """\
launch:
  - arg: {name: robot}
  - arg:
      name: world
      default: arena
      description: where
      choice: [{value: arena}, {value: maze}]
  - arg: {name: home, default: "$(env HOME)"}
  - node: {pkg: x, exec: y}
  - group:
      - if: $(var robot)
      - arg: {name: inner, default: 1}
      - include:
          file: $(find-pkg-share demo)/launch/b.launch.xml
          arg: [{name: given, value: x}]
  - arg: {name: seldom, default: "", unless: $(var robot)}
  - include: {file: $(dirname)/c.launch.py, let: [{name: other, value: x}]}
  - include: {file: $(var robot).launch.py}
""",
    "a.launch.xml": """\
<launch>
  <arg name="robot"/>
  <arg name="world" default="arena" description="where"><choice value="arena"/><choice value="maze"/></arg>
  <arg name="home" default="$(env HOME)"/>
  <node pkg="x" exec="y"/>
  <group if="$(var robot)">
    <arg name="inner" default="1"/>
    <include file="$(find-pkg-share demo)/launch/b.launch.xml"><arg name="given" value="x"/></include>
  </group>
  <arg name="seldom" default="" unless="$(var robot)"/>
  <include file="$(dirname)/c.launch.py"><let name="other" value="x"/></include>
  <include file="$(var robot).launch.py"/>
</launch>
""",
    "a.launch.py": """\
import os
from ament_index_python.packages import get_package_share_directory as share_of
from launch import LaunchDescription, actions
from launch.actions import DeclareLaunchArgument as Arg, GroupAction, IncludeLaunchDescription

raise SystemExit("nobody executes this")

def generate_launch_description():
    demo = share_of("demo")
    worlds = ["arena", "maze"]
    return LaunchDescription([
        Arg("robot"),
        Arg(name="world", default_value="arena", description="where", choices=worlds),
        Arg("home", default_value=EnvironmentVariable("HOME")),
        Node(package="x", executable="y"),
        GroupAction(condition=IfCondition(LaunchConfiguration("robot")), actions=[
            Arg("inner", default_value=str(1)),
            IncludeLaunchDescription(
                XMLLaunchDescriptionSource(os.path.join(demo, "launch", "b.launch.xml")),
                launch_arguments={"given": "x"}.items(),
            ),
        ]),
        actions.DeclareLaunchArgument("seldom", default_value="", condition=UnlessCondition("x")),
        IncludeLaunchDescription(
            launch_description_source=[ThisLaunchFileDir(), "/c.launch.py"], launch_arguments=[("other", "x")]
        ),
        IncludeLaunchDescription(PythonLaunchDescriptionSource([LaunchConfiguration("robot"), ".launch.py"])),
    ])
""",
}


@pytest.mark.parametrize("name", _TEXTS)
def test_what_is_seen(look: Look, name: str, tmp_path: object) -> None:
    home = "EnvironmentVariable('HOME')" if name.endswith(".py") else "$(env HOME)"
    assert look(name, _TEXTS[name]) == Glance(
        (
            SeenArgument("robot", None, constant=False, choices=(), description=None, conditional=False),
            SeenArgument("world", "arena", True, ("arena", "maze"), "where", conditional=False),
            SeenArgument("home", home, constant=False, choices=(), description=None, conditional=False),
            SeenArgument("inner", "1", constant=True, choices=(), description=None, conditional=True),
            SeenArgument("seldom", "", constant=True, choices=(), description=None, conditional=True),
        ),
        (
            SeenInclude("/s/launch/b.launch.xml", frozenset({"given"}), conditional=True),
            SeenInclude(f"{tmp_path}/c.launch.py", frozenset({"other"}), conditional=False),
        ),
    )


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.yaml", "launch: ["),
        ("a.yaml", "launch: {arg: x}"),
        ("a.yaml", "- launch"),
        ("a.yaml", "launch: [arg, {arg: x}, {arg: {name: [x]}}, {include: {file: [x]}}, {group: x}, null]"),
        ("a.yaml", "launch: &x [{group: *x}]"),
        ("a.yaml", ""),
        ("a.xml", "<launch><arg"),
        ("a.xml", "<launch><arg/><include/><include file=''/></launch>"),
        ("a.py", "def x(:"),
        ("a.py", "DeclareLaunchArgument()\nDeclareLaunchArgument(name)\nIncludeLaunchDescription()"),
        ("a.py", f"x = {'(' * 500}"),
        ("a.py", "\0"),
        ("a.txt", "launch: [{arg: {name: x}}]"),
        ("a.yaml", f"launch: [{{arg: {{name: x}}}}] #{'x' * (1 << 20)}"),
    ],
)
def test_what_cannot_be_seen_shows_nothing(look: Look, name: str, text: str) -> None:
    assert look(name, text) == Glance()
