"""Resolving takes a time in proportion to the size of what is launched. Calls are counted, since times vary."""

from __future__ import annotations

import cProfile
import os
import pstats
from typing import TYPE_CHECKING

import pytest

from orchestra import pipeline
from orchestra.errors import Problems

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

_PER_FILE = 5


def _python(number: int, inner: list[int]) -> str:
    nodes = [
        f"Node(executable='/bin/true', name='n{number}_{index}', namespace=LaunchConfiguration('ns'),"
        f" parameters=[{{'x': {index}, 'y': LaunchConfiguration('ns')}}], remappings=[('a', 'b')])"
        for index in range(_PER_FILE)
    ]
    includes = [
        f"IncludeLaunchDescription(PythonLaunchDescriptionSource([ThisLaunchFileDir(), '/f{other}.py']),"
        " launch_arguments={'ns': LaunchConfiguration('ns')}.items())"
        for other in inner
    ]
    entities = ",\n        ".join(["DeclareLaunchArgument('ns', default_value='space')", *nodes, *includes])
    return f"""
from launch import LaunchDescription
from launch.actions import *
from launch.launch_description_sources import *
from launch.substitutions import *
from launch_ros.actions import Node
def generate_launch_description():
    return LaunchDescription([
        {entities}])
"""


def _xml(number: int, inner: list[int]) -> str:
    nodes = [
        f'<node exec="/bin/true" name="n{number}_{index}" namespace="$(var ns)">'
        f'<param name="x" value="{index}"/><param name="y" value="$(var ns)"/><remap from="a" to="b"/></node>'
        for index in range(_PER_FILE)
    ]
    includes = [
        f'<include file="$(dirname)/f{other}.xml"><arg name="ns" value="$(var ns)"/></include>'
        for other in inner
    ]
    return "\n".join(["<launch>", '<arg name="ns" default="space"/>', *nodes, *includes, "</launch>"])


def _yaml(number: int, inner: list[int]) -> str:
    nodes = [
        f"- node: {{exec: /bin/true, name: n{number}_{index}, namespace: $(var ns),"
        f" param: [{{name: x, value: {index}}}, {{name: y, value: $(var ns)}}], remap: [{{from: a, to: b}}]}}"
        for index in range(_PER_FILE)
    ]
    includes = [
        f"- include: {{file: $(dirname)/f{other}.yaml, arg: [{{name: ns, value: $(var ns)}}]}}"
        for other in inner
    ]
    return "\n".join(["launch:", "- arg: {name: ns, default: space}", *nodes, *includes])


_WRITERS: dict[str, Callable[[int, list[int]], str]] = {"py": _python, "xml": _xml, "yaml": _yaml}
_SHAPES: dict[str, Callable[[int], list[int]]] = {
    "a tree": lambda number: [2 * number + 1, 2 * number + 2],
    "a chain": lambda number: [number + 1],
}


def _calls(folder: Path, ending: str, shape: str, files: int) -> int:
    """Return how many calls it takes to plan a launch of so many files, each included by another."""
    folder.mkdir()
    for number in range(files):
        inner = [other for other in _SHAPES[shape](number) if other < files]
        (folder / f"f{number}.{ending}").write_text(_WRITERS[ending](number, inner))
    inputs = pipeline.inputs_from([], environment=dict(os.environ))
    problems = Problems()
    profile = cProfile.Profile()
    profile.enable()
    plan = pipeline.collect(str(folder / f"f0.{ending}"), inputs, problems)
    profile.disable()
    assert not problems.errors
    assert plan is not None
    assert len(plan.processes) == files * _PER_FILE
    total: int = pstats.Stats(profile).total_calls  # type: ignore[attr-defined] # typeshed does not know it
    return total


# So many calls a node takes at most, a fifth of an include among them; Python's own front end takes more.
_MOST = {"py": 1850, "xml": 1600, "yaml": 1450}


@pytest.mark.parametrize("shape", _SHAPES)
@pytest.mark.parametrize("ending", _WRITERS)
def test_twice_the_size_takes_twice_the_work(tmp_path: Path, ending: str, shape: str) -> None:
    _calls(tmp_path / "warm", ending, shape, 3)
    once = _calls(tmp_path / "once", ending, shape, 30)
    twice = _calls(tmp_path / "twice", ending, shape, 60)
    assert twice < 2.12 * once, f"{once} calls, then {twice}"
    assert twice - once < 30 * _PER_FILE * _MOST[ending], f"{(twice - once) / (30 * _PER_FILE)} a node"


@pytest.mark.long
@pytest.mark.parametrize("ending", _WRITERS)
def test_a_thousand_nodes_are_no_other_case(tmp_path: Path, ending: str) -> None:
    _calls(tmp_path / "warm", ending, "a tree", 3)
    once = _calls(tmp_path / "once", ending, "a tree", 50)
    four_times = _calls(tmp_path / "more", ending, "a tree", 200)
    assert four_times < 4.3 * once
