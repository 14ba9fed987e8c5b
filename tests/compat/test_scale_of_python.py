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


def _tuples(count: int) -> str:
    """Return names with a comma at the end of their line: each is told of, and what it causes is told there."""
    names = "".join(f"    c{number} = 'x{number}',\n" for number in range(count))
    node = "Node(package=c{0}, executable='e', name=f'{{c{0}}}', parameters=[{{'a': c{0}}}])"
    nodes = "".join(f"        {node.format(number)},\n" for number in range(count))
    return f"{names}    return LaunchDescription([\n{nodes}    ])\n"


def _repeated(lines: str) -> Callable[[int], str]:
    def made(count: int) -> str:
        return f"{''.join(lines.format(number=number) for number in range(count))}    return LaunchDescription([])\n"

    return made


_KINDS: dict[str, Callable[[int], str]] = {
    "keywords that there are none of": _listed(", nmae='x'"),
    "actions that are added to nothing": _unadded,
    "generators that are gone through twice": _repeated(
        "    g{number} = (x for x in [1])\n    a{number} = list(g{number})\n    b{number} = list(g{number})\n"
    ),
    "lists that calls share": _repeated(
        "    def f{number}(a=[]):\n        a.append(1)\n    f{number}()\n    f{number}()\n"
    ),
    "tuples that a comma makes": _tuples,
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
