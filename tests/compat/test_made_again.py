"""Objects that are initialized again: what they are made of then counts, whatever has been asked of them before."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Problems
from orchestra.pipeline import collect, inputs_from

if TYPE_CHECKING:
    from pathlib import Path

_FILE = """
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch_ros.actions import ComposableNodeContainer, Node
from launch_ros.descriptions import ComposableNode

def generate_launch_description():
    process = ExecuteProcess(cmd=['/bin/echo', 'a'], name='first')
    component = ComposableNode(package='demo', plugin='demo::A', name='a')
    node = Node(package='demo', executable='a', name='a', parameters=[{{'a': 1}}])
    {asked}
    process.__init__(cmd=['/bin/echo', 'b'], name='second')
    component.__init__(package='demo', plugin='demo::B', name='d')
    node.__init__(package='demo', executable='b', name='b', parameters=[{{'b': 2}}])
    held = ComposableNodeContainer(
        package='demo', executable='c', name='c', namespace='', composable_node_descriptions=[component])
    return LaunchDescription([process, node, held])
"""


@pytest.mark.parametrize("asked", ["", "process.cmd, component.parameters, node.cmd"])
def test_what_an_object_is_made_of_again_counts(asked: str, tmp_path: Path) -> None:
    file = tmp_path / "a.launch.py"
    file.write_text(_FILE.format(asked=asked))
    plan = collect(str(file), inputs_from((), environment={"PATH": "/usr/bin:/bin"}), Problems())
    assert plan is not None
    assert [item.id for item in plan.processes] == ["second", "/b", "/c"]
    assert plan.processes[0].command == ("/bin/echo", "b")
    assert plan.processes[1].parameters == {"b": 2}
    assert [(item.id, item.plugin) for item in plan.components] == [("/d", "demo::B")]
