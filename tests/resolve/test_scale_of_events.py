"""So many events and handlers of Python files take a work in proportion. Steps of the interpreter are counted."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, Any

import pytest

from orchestra import pipeline
from orchestra.errors import Problems

if TYPE_CHECKING:
    from pathlib import Path
    from types import FrameType

_HEAD = """
from launch import LaunchDescription
from launch.actions import *
from launch.event_handlers import *
from launch.events.process import *
from launch_ros.actions import LifecycleNode, Node
from launch_ros.events import matches_node_name
from launch_ros.events.lifecycle import ChangeState

def generate_launch_description():
    ld = LaunchDescription()
    nodes = [LifecycleNode(executable='/bin/true', name=f'n{i}', namespace='') for i in range(COUNT)]
    handlers = [OnShutdown(on_shutdown=[LogInfo(msg='over')]) for i in range(COUNT)]
    timers = [TimerAction(period=1.0, actions=[LogInfo(msg='now')]) for i in range(COUNT)]
    logs = [LogInfo(msg='now') for i in range(COUNT)]
"""
_KINDS = {
    "processes by their names": (
        "nodes",
        "EmitEvent(event=ShutdownProcess(process_matcher=matches_name(f'true-{i + 1}')))",
    ),
    "processes by their programs": (
        "nodes",
        "EmitEvent(event=ShutdownProcess(process_matcher=matches_executable(f'true{i}')))",
    ),
    "processes by their numbers": (
        "nodes",
        "EmitEvent(event=ShutdownProcess(process_matcher=matches_pid(i)))",
    ),
    "nodes by their names": (
        "nodes",
        "EmitEvent(event=ChangeState(lifecycle_node_matcher=matches_node_name(f'/n{i}'), transition_id=1))",
    ),
    "ends of processes": (
        "nodes",
        "RegisterEventHandler(OnProcessExit(target_action=nodes[i], on_exit=[LogInfo(msg='over')]))",
    ),
    "handlers that wait no more": (
        "map(RegisterEventHandler, handlers)",
        "UnregisterEventHandler(handlers[i])",
    ),
    "ends of timers": (
        "timers",
        "RegisterEventHandler(OnExecutionComplete(target_action=timers[i], on_completion=[LogInfo(msg='over')]))",
    ),
    "ends of actions": (
        "logs",
        "RegisterEventHandler(OnExecutionComplete(target_action=logs[i], on_completion=[LogInfo(msg='over')]))",
    ),
}


class _Steps:
    """Counts the steps of the interpreter's loop."""

    def __init__(self) -> None:
        self.count = 0

    def begun(self, frame: FrameType, _event: str, _argument: object) -> Any:
        """Count in one more frame."""
        frame.f_trace_opcodes = True
        frame.f_trace_lines = False
        return self.counted

    def counted(self, _frame: FrameType, event: str, _argument: object) -> Any:
        """Count a step."""
        self.count += event == "opcode"
        return self.counted


def _steps(folder: Path, kind: str, count: int) -> int:
    first, then = _KINDS[kind]
    path = folder / f"n{count}.launch.py"
    path.write_text(
        f"{_HEAD.replace('COUNT', str(count))}    for action in {first}:\n        ld.add_action(action)\n"
        f"    for i in range({count}):\n        ld.add_action({then})\n    return ld\n"
    )
    inputs = pipeline.inputs_from([], environment=dict(os.environ))
    problems, steps, before = Problems(), _Steps(), sys.gettrace()
    sys.settrace(steps.begun)
    try:
        pipeline.collect(str(path), inputs, problems)
    finally:
        sys.settrace(before)
    assert not problems.errors
    return steps.count


@pytest.mark.parametrize("kind", _KINDS)
def test_twice_as_many_take_twice_the_work(tmp_path: Path, kind: str) -> None:
    _steps(tmp_path, kind, 60)
    once, twice, four_times = (_steps(tmp_path, kind, count) for count in (60, 120, 240))
    assert four_times - twice < 2.2 * (twice - once), f"{once} steps, then {twice} and {four_times}"
