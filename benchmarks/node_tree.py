"""Trees of launch files that include each other and describe many nodes, in each of the three languages."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from benchmarks import levels

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from pathlib import Path

# So many nodes in a file.
_NODES: Final = 20
# Given to files that include others, and handed on.
_NOBODY: Final = "robot"

_PARAMETERS: Final = """\
/**:
  ros__parameters:
    frequency: {n}.5
    frames: [map, odom]
    limits:
      lower: -{n}.0
      upper: {n}.0
"""
YAML_NODE: Final = """\
  - node:
      pkg: benchmark_widget
      exec: widget
      name: widget{n}
      namespace: $(var robot)
      param:
        - {{name: rate, value: {n}.5}}
        - {{name: frame, value: $(var robot)/base{n}}}
      remap:
        - {{from: scan, to: scan{n}}}
        - {{from: odom, to: /$(var robot)/odom}}
"""
_XML_NODE: Final = """\
  <node pkg="benchmark_widget" exec="widget" name="widget{n}" namespace="$(var robot)">
    <param name="rate" value="{n}.5"/>
    <param name="frame" value="$(var robot)/base{n}"/>
    <remap from="scan" to="scan{n}"/>
    <remap from="odom" to="/$(var robot)/odom"/>
  </node>
"""
_PYTHON: Final = """\
import os

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

FOLDER = os.path.dirname(__file__)


def generate_launch_description():
    robot = LaunchConfiguration("robot")
    return LaunchDescription([
{actions}    ])
"""
_PYTHON_NODE: Final = """\
        Node(
            package="benchmark_widget", executable="widget", name="widget{n}", namespace=robot,
            parameters=[{{"rate": {n}.5, "frame": [robot, "/base{n}"]}}],
            remappings=[("scan", "scan{n}"), ("odom", ["/", robot, "/odom"])],
        ),
"""

_PYTHON_INCLUDE: Final = """\
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(os.path.join(FOLDER, "{file}")),
            launch_arguments={{"robot": "{robot}"}}.items(),
        ),
"""


def write(folder: Path, language: str, nodes: int) -> Path:
    """Write a tree with so many nodes in `yaml`, `xml` or `py`; return the file at its top."""
    write_package(folder)
    whole, node, include = _LANGUAGES[language]
    folder = folder / f"{language}{nodes}"
    folder.mkdir()
    level = []
    for number in range(0, nodes, _NODES):
        path = folder / f"robot{number}.launch.{language}"
        path.write_text(
            whole((node.format(n=n) for n in range(number, min(nodes, number + _NODES))), argument=True)
        )
        level.append((path.name, f"robot{number}"))

    def including(name: str, files: Sequence[levels.File]) -> levels.File:
        path = folder / f"{name}.launch.{language}"
        path.write_text(
            whole((include.format(file=file, robot=robot) for file, robot in files), argument=False)
        )
        return path.name, _NOBODY

    return folder / levels.top(level, including)


def write_package(folder: Path) -> None:
    """Write the package that all nodes are of."""
    package = folder / "benchmark_widget" / "nodes"
    package.mkdir(parents=True, exist_ok=True)
    for path in (package.parent / "__init__.py", package / "__init__.py", package / "widget.py"):
        path.touch()


def write_parameters(path: Path, number: int) -> None:
    """Write a parameter file for all nodes."""
    path.write_text(_PARAMETERS.format(n=number))


def _yaml(actions: Iterable[str], *, argument: bool) -> str:
    return "launch:\n" + ("  - arg: {name: robot}\n" if argument else "") + "".join(actions)


def _xml(actions: Iterable[str], *, argument: bool) -> str:
    return "<launch>\n" + ('  <arg name="robot"/>\n' if argument else "") + "".join(actions) + "</launch>\n"


def _python(actions: Iterable[str], *, argument: bool) -> str:
    first = '        DeclareLaunchArgument("robot"),\n' if argument else ""
    return _PYTHON.format(actions=first + "".join(actions))


_LANGUAGES: Final[dict[str, tuple[Callable[..., str], str, str]]] = {
    "yaml": (
        _yaml,
        YAML_NODE,
        "  - include: {{file: $(dirname)/{file}, arg: [{{name: robot, value: '{robot}'}}]}}\n",
    ),
    "xml": (
        _xml,
        _XML_NODE,
        '  <include file="$(dirname)/{file}"><arg name="robot" value="{robot}"/></include>\n',
    ),
    "py": (
        _python,
        _PYTHON_NODE,
        _PYTHON_INCLUDE,
    ),
}
