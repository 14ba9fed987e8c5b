"""`orchestra launch --show-args`: every argument that a launch takes, and nothing is started."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

    from .conftest import Command


@pytest.fixture
def orchestra(orchestra_quickly: Command) -> Command:
    """Run the command; what starts nothing, in this process."""
    return orchestra_quickly


_YAML = {
    "outer.launch.yaml": """\
launch:
  - arg: {name: who, default: world, choices: [world, moon], description: "whom\\nto greet"}
  - arg: {name: how}
  - arg: {name: rviz, default: "false"}
  - arg: {name: part, default: inner}
  - include: {file: $(var part).launch.yaml, arg: [{name: given, value: x}]}
  - include: {file: view.launch.yaml, if: $(var rviz)}
""",
    "inner.launch.yaml": """\
launch:
  - arg: {name: given}
  - arg: {name: place, default: $(env PLACE)/maps}
  - arg: {name: speed, description: metres a second}
""",
    "view.launch.yaml": "launch: [{arg: {name: layout, default: wide}}, {arg: {name: given, description: x}}]\n",
}
_XML = {
    "outer.launch.xml": """\
<launch>
  <arg name="who" default="world" description="whom&#10;to greet"><choice value="world"/><choice value="moon"/></arg>
  <arg name="how"/>
  <arg name="rviz" default="false"/>
  <arg name="part" default="inner"/>
  <include file="$(dirname)/$(var part).launch.xml"><arg name="given" value="x"/></include>
  <include file="$(dirname)/view.launch.xml" if="$(var rviz)"/>
</launch>
""",
    "inner.launch.xml": """\
<launch>
  <arg name="given"/>
  <arg name="place" default="$(env PLACE)/maps"/>
  <arg name="speed" description="metres a second"/>
</launch>
""",
    "view.launch.xml": (
        '<launch><arg name="layout" default="wide"/><arg name="given" description="x"/></launch>\n'
    ),
}
_IMPORTS = """\
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, OpaqueFunction
from launch.conditions import IfCondition
from launch.substitutions import EnvironmentVariable, LaunchConfiguration, PathJoinSubstitution, ThisLaunchFileDir

def beside(*parts):
    return PathJoinSubstitution([ThisLaunchFileDir(), *parts])

"""
_PYTHON = {
    "outer.launch.py": f"""{_IMPORTS}
def generate_launch_description():
    view = PathJoinSubstitution([ThisLaunchFileDir(), "view.launch.py"])
    return LaunchDescription([
        DeclareLaunchArgument("who", default_value="world", choices=["world", "moon"], description="whom\\nto greet"),
        DeclareLaunchArgument("how"),
        DeclareLaunchArgument("rviz", default_value="false"),
        DeclareLaunchArgument("part", default_value="inner"),
        IncludeLaunchDescription(
            beside([LaunchConfiguration("part"), ".launch.py"]), launch_arguments=[("given", "x")]
        ),
        IncludeLaunchDescription(view, condition=IfCondition(LaunchConfiguration("rviz"))),
        OpaqueFunction(function=lambda context: print(LaunchConfiguration("how").perform(context))),
    ])
""",
    "inner.launch.py": f"""{_IMPORTS}
def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("given"),
        DeclareLaunchArgument("place", default_value=[EnvironmentVariable("PLACE"), "/maps"]),
        DeclareLaunchArgument("speed", description="metres a second"),
    ])
""",
    "view.launch.py": f"""{_IMPORTS}
def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("layout", default_value="wide"), DeclareLaunchArgument("given", description="x")
    ])
""",
}
_SHOWN = """\
Arguments of outer.launch.END, given as NAME:=VALUE:

    'who':
        whom
        to greet
        (default: 'world')
        (choices: 'world', 'moon')

    'how':
        no description
        (required)

    'rviz':
        no description
        (default: 'false')

    'part':
        no description
        (default: 'inner')

    'place':
        no description
        (default: '$(env PLACE)/maps')
        (now: '/home/maps')
        (in inner.launch.END)

    'speed':
        metres a second
        (required)
        (in inner.launch.END)

    'layout':*
        no description
        (default: 'wide')
        (in view.launch.END)

    'given':*
        x
        (required)
        (in view.launch.END)

* Only where a condition holds.
"""


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    for name, text in {**_YAML, **_XML, **_PYTHON}.items():
        (folder / name).write_text(text)


@pytest.mark.conforms("5.1 --show-args", "5.4 -s", "D46")
@pytest.mark.parametrize("ending", ["yaml", "xml", "py"])
def test_what_is_shown(orchestra_beside: Command, home: Path, ending: str) -> None:
    """Arguments of includes too, one of which is found by an argument, one behind a condition."""
    found = orchestra_beside("launch", "-s", f"outer.launch.{ending}", PLACE="/home")
    assert found.stdout.replace(f".launch.{ending}", ".launch.END") == _SHOWN
    assert (found.returncode, found.stderr) == (0, "")
    assert not home.exists()


@pytest.mark.conforms("5.1 --show-args")
@pytest.mark.parametrize(
    "words",
    [
        ("-s", "inner.launch.yaml"),
        ("inner.launch.yaml", "-s"),
        ("inner.launch.yaml", "speed:=2", "--show-args"),
        ("--show-arguments", "inner.launch.yaml", "-n"),
        ("-ns", "inner.launch.yaml"),
    ],
)
def test_ways_to_ask(orchestra: Command, words: tuple[str, ...]) -> None:
    found = orchestra("launch", *words, PLACE="/home")
    assert (found.returncode, found.stderr) == (0, "")
    assert found.stdout.startswith("Arguments of inner.launch.yaml, given as NAME:=VALUE:\n\n    'given':\n")


def test_what_is_given_is_shown_and_counts(orchestra: Command) -> None:
    found = orchestra("launch", "-s", "outer.launch.yaml", "who:=moon", "rviz:=true", PLACE="/home")
    assert (found.returncode, found.stderr) == (0, "")
    assert "        (default: 'world')\n        (now: 'moon')\n" in found.stdout
    assert "    'layout':*\n" in found.stdout


def test_no_arguments_is_said(orchestra: Command, folder: Path) -> None:
    (folder / "none.launch.yaml").write_text("launch: []\n")
    assert orchestra("launch", "-s", "none.launch.yaml").stdout == "none.launch.yaml has no arguments.\n"


def test_arguments_are_shown_in_spite_of_other_faults_which_are_told(
    orchestra: Command, folder: Path
) -> None:
    (folder / "bad.launch.yaml").write_text("launch:\n  - arg: {name: a, default: b}\n  - nod: {}\n")
    found = orchestra("launch", "-s", "bad.launch.yaml")
    assert found.returncode == 2
    assert "    'a':\n" in found.stdout
    assert "bad.launch.yaml:3:5: error: " in found.stderr


def test_a_file_that_cannot_be_read_is_a_mistake(orchestra: Command, folder: Path) -> None:
    (folder / "bad.launch.yaml").write_text("launch: [\n")
    found = orchestra("launch", "-s", "bad.launch.yaml")
    assert (found.returncode, found.stdout) == (2, "")
    assert "bad.launch.yaml:" in found.stderr


@pytest.mark.conforms("5.1 --show-args", "5.1 --print")
def test_arguments_and_plan_cannot_be_shown_together(orchestra: Command) -> None:
    found = orchestra("launch", "-s", "-p", "outer.launch.yaml")
    assert (found.returncode, found.stdout) == (2, "")
    assert "not allowed with" in found.stderr
