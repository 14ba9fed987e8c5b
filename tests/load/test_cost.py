"""What it costs to read a launch file, in calls of functions: times vary, and say little on a busy machine."""

from __future__ import annotations

import cProfile
import pstats
from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Problems
from orchestra.load.files import load

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path


def _yaml(nodes: int) -> str:
    node = (
        "- node:\n    exec: /bin/true\n    name: node_{0}\n    namespace: $(var ns)\n"
        "    param:\n    - {{name: rate, value: {0}.5}}\n    - {{name: frame, value: $(var ns)/base_{0}}}\n"
        "    remap:\n    - {{from: scan, to: scan_{0}}}\n    - {{from: odom, to: /$(var ns)/odom}}\n"
    )
    return "launch:\n" + "".join(map(node.format, range(nodes)))


def _xml(nodes: int) -> str:
    node = (
        '<node exec="/bin/true" name="node_{0}" namespace="$(var ns)">'
        '<param name="rate" value="{0}.5"/><param name="frame" value="$(var ns)/base_{0}"/>'
        '<remap from="scan" to="scan_{0}"/><remap from="odom" to="/$(var ns)/odom"/></node>\n'
    )
    return "<launch>" + "".join(map(node.format, range(nodes))) + "</launch>"


def _calls(path: Path, text: str) -> int:
    path.write_text(text)
    problems = Problems()
    profile = cProfile.Profile()
    profile.enable()
    description = load(str(path), problems)
    profile.disable()
    assert description is not None
    assert not problems
    total: int = pstats.Stats(profile).total_calls  # type: ignore[attr-defined] # typeshed does not know it
    return total


# A node with two parameters and two remappings: 28 words in the file, 5 models. It took 1,575 and 1,424 calls once, 158
# and 169 when its form was learned and its texts and their places were all made.
@pytest.mark.parametrize(("ending", "written", "most"), [("yaml", _yaml, 90), ("xml", _xml, 100)])
def test_a_node_takes_so_many_calls(
    tmp_path: Path, ending: str, written: Callable[[int], str], most: int
) -> None:
    _calls(tmp_path / f"learned.launch.{ending}", written(20))
    fewer = _calls(tmp_path / f"fewer.launch.{ending}", written(20))
    more = _calls(tmp_path / f"more.launch.{ending}", written(60))
    assert (more - fewer) / 40 < most
