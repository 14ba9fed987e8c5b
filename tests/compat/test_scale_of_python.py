"""So many mistakes in a Python file take a work in proportion. Calls are counted, since times vary."""

from __future__ import annotations

import cProfile
import os
import pstats
from typing import TYPE_CHECKING

import pytest

from orchestra import pipeline

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

_NODE = "Node(package='p', executable='/bin/true', name='n{number}'{more})"


def _listed(more: str) -> Callable[[int], str]:
    def made(count: int) -> str:
        nodes = "".join(f"        {_NODE.format(number=number, more=more)},\n" for number in range(count))
        return f"    return LaunchDescription([\n{nodes}    ])\n"

    return made


def _unadded(count: int) -> str:
    nodes = "".join(f"    n{number} = {_NODE.format(number=number, more='')}\n" for number in range(count))
    return f"{nodes}    return LaunchDescription([])\n"


_KINDS: dict[str, Callable[[int], str]] = {
    "keywords that there are none of": _listed(", nmae='x'"),
    "actions that are added to nothing": _unadded,
}


def _calls(folder: Path, body: str) -> int:
    path = folder / "main.launch.py"
    imports = "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n"
    path.write_text(f"{imports}def generate_launch_description():\n{body}")
    inputs = pipeline.inputs_from([], environment=dict(os.environ))
    profile = cProfile.Profile()
    profile.enable()
    problems = pipeline.check(str(path), inputs)
    profile.disable()
    assert problems
    total: int = pstats.Stats(profile).total_calls  # type: ignore[attr-defined] # typeshed does not know it
    return total


@pytest.mark.parametrize("kind", _KINDS)
def test_twice_as_many_take_twice_the_work(tmp_path: Path, kind: str) -> None:
    made = _KINDS[kind]
    _calls(tmp_path, made(60))
    once, twice, four_times = (_calls(tmp_path, made(count)) for count in (60, 120, 240))
    assert four_times - twice < 2.2 * (twice - once), f"{once} calls, then {twice} and {four_times}"
