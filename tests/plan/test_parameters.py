"""Parameters that are each written once, at the node or in files, come to the same without the closer look that others take."""

from __future__ import annotations

import os
import random
from typing import TYPE_CHECKING, Any

import pytest

from orchestra import pipeline
from orchestra.errors import Problems
from orchestra.plan import parameters
from orchestra.plan.codec import dumps

if TYPE_CHECKING:
    from pathlib import Path

_NAMES = ("a", "a.b", "a.b.c", "b", "yes", "x y", "/c", "use_sim_time")
_VALUES = (
    *("1", "2.5", "true", "'quoted'", "text", "[1, 2]", "[a, b]", "''", "$(var v)"),
    *("$(var v)/$(var w)", "'1'"),
)
_PLACES = ("", ", name: n{0}", ", name: n{0}, namespace: x", ", namespace: x", ", name: /n{0}, namespace: /")


# The keys of sections, and lines of them; nested groups take the slots of others.
_PATTERNS = ("/**", "n0", "/n1", "/**/n2", "/x/n3", "x/n3", "x: {n1", "n4", "/other", "/*")
_SET = (
    "a: 1",
    "c: 2.5",
    "d: {e: 1, f: [1, 2]}",
    "a.b: x",
    "b: true",
    "g: [left, right]",
    "h: {i: {j: 1}}",
    "c: y",
)


def _file(chance: random.Random) -> str:
    lines = []
    for pattern in chance.sample(_PATTERNS, k=chance.randrange(1, 5)):
        values = "".join(f"    {line}\n" for line in chance.sample(_SET, k=chance.randrange(1, 4)))
        if "{" in pattern:
            lines.append(
                "x:\n  n1:\n    ros__parameters:\n" + "".join(f"  {line}\n" for line in values.splitlines())
            )
        else:
            lines.append(f"{pattern}:\n  ros__parameters:\n{values}")
    return "".join(lines)


def _described(chance: random.Random) -> str:
    lines = ["launch:", "- arg: {name: v, default: '3'}", "- let: {name: w, value: $(var v)x}"]
    for number in range(5):
        names = chance.choices(_NAMES, k=chance.randrange(4))
        written = [f"{{name: {name}, value: {chance.choice(_VALUES)}}}" for name in names]
        written += [f"{{from: $(dirname)/p{chance.randrange(3)}.yaml}}" for _ in range(chance.randrange(3))]
        chance.shuffle(written)
        given = ", ".join(written)
        place = chance.choice(_PLACES).format(number)
        lines.append(f"- node: {{exec: /bin/true, exec_name: e{number}{place}, param: [{given}]}}")
        if chance.random() < 0.15:
            lines.append(
                f"- set_parameter: {{name: {chance.choice(_NAMES)}, value: {chance.choice(_VALUES)}}}"
            )
    return "\n".join(lines) + "\n"


_PYTHON = """\
import os
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node

FOLDER = os.path.dirname(__file__)


def called(name):
    return LaunchConfiguration(name)


def generate_launch_description():
    v = LaunchConfiguration('v')
    return LaunchDescription([
        DeclareLaunchArgument('v', default_value='3'),
        DeclareLaunchArgument('w', default_value='x'),
        DeclareLaunchArgument('p', default_value='p1.yaml'),
"""
_WRITTEN = (
    *("1", "2.5", "True", "'text'", "[1, 2]", "['a', v]", "v", "v", "LaunchConfiguration('w')"),
    *("called('v')", "called('w')", "{'a': 1, 'b': v}"),
)
_FILES = (
    *("os.path.join(FOLDER, 'p0.yaml')", "PathJoinSubstitution([FOLDER, called('p')])"),
    "PathJoinSubstitution([FOLDER, 'p2.yaml'])",
)


def _described_in_python(chance: random.Random) -> str:
    lines = []
    for number in range(6):
        names = chance.sample(_NAMES, k=chance.randrange(4))
        written = [f"{{{name!r}: {chance.choice(_WRITTEN)}}}" for name in names]
        written += chance.sample(_FILES, k=chance.randrange(2))
        chance.shuffle(written)
        place = f", name='n{number}'" if chance.random() < 0.8 else ""
        place += ", namespace='/x'" if chance.random() < 0.5 else ""
        lines.append(f"        Node(executable='/bin/true'{place}, parameters=[{', '.join(written)}]),\n")
    return f"{_PYTHON}{''.join(lines)}    ])\n"


def _found(path: Path, *, whole: bool) -> tuple[Any, Any]:
    problems = Problems()
    with pipeline.opened(
        str(path), pipeline.inputs_from((), environment=dict(os.environ)), problems, whole=whole
    ) as launch:
        assert launch is not None
        found = [(item.parameters, item.parameter_files) for item in launch.plan.processes]
        return (dumps(launch.plan) if whole else found), problems.ordered


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("language", ["yaml", "py"])
def test_a_closer_look_finds_the_same(
    language: str, seed: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    chance = random.Random(seed)  # noqa: S311 - the same each time
    path = tmp_path / f"main.launch.{language}"
    path.write_text(_described(chance) if language == "yaml" else _described_in_python(chance))
    for number in range(3):
        (tmp_path / f"p{number}.yaml").write_text(_file(chance))
    plainly = [_found(path, whole=whole) for whole in (True, False)]
    monkeypatch.setattr(parameters, "_plain", lambda *_, **__: None)
    assert plainly == [_found(path, whole=whole) for whole in (True, False)]
