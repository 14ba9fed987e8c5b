"""What launch files in Python do about events, in real runs."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from tests.compat import plans

if TYPE_CHECKING:
    from pathlib import Path

_DEADLINE = 60.0
_BEFORE = """
import asyncio

async def greet(context, text):
    await asyncio.sleep(0)
    print(text, flush=True)

def ended(event, context):
    return [LogInfo(msg=f'on_exit {event.returncode} {event.action.get_stdout().strip()} {context.locals.event is event}')]

process = ExecuteProcess(cmd=['sh', '-c', 'echo ready; sleep 0.3; exit 3'], cached_output=True, on_exit=ended)
sleeper = ExecuteProcess(cmd=['sleep', '60'])
"""
_ACTIONS = """
    SetLaunchConfiguration('a', 'frozen'),
    GroupAction([
        SetLaunchConfiguration('a', 'inside'),
        RegisterEventHandler(OnProcessExit(target_action=process, on_exit=[LogInfo(msg=['first ', LC('a')])])),
    ]),
    RegisterEventHandler(OnProcessExit(target_action=process, on_exit=lambda event, context: [
        LogInfo(msg=['second ', LC('a')]),
        TimerAction(period=0.1, actions=[EmitEvent(event=ShutdownProcess(process_matcher=matches_action(sleeper)))]),
    ])),
    OpaqueCoroutine(coroutine=greet, args=['from a coroutine']),
    RegisterEventHandler(OnProcessIO(target_action=process, on_stdout=lambda event: [LogInfo(msg='io ' + event.text.decode().strip())])),
    RegisterEventHandler(OnProcessExit(target_action=sleeper, on_exit=[Shutdown(reason='the sleeper is gone')])),
    RegisterEventHandler(OnShutdown(on_shutdown=[LogInfo(msg='shutting down')])),
    sleeper,
    process,
"""


@pytest.mark.conforms(
    "7 6",
    "4.1 4",
    "4.8 on_exit",
    "4.9 8",
    "1.7 OnProcessIO",
    "1.7 OnShutdown",
    "1.3.2 on_exit",
    "1.3.2 cached_output",
    "D26",
    "4.12 on output",
    "4.12 at shutdown",
)
def test_handlers_are_called_newest_first_with_the_scope_they_were_written_in(tmp_path: Path) -> None:
    path = plans.write(tmp_path / "a.launch.py", _ACTIONS, _BEFORE)
    run = subprocess.run(
        [sys.executable, "-m", "orchestra", "launch", str(path)],
        capture_output=True,
        text=True,
        timeout=_DEADLINE,
        check=False,
        env={**os.environ, "XDG_STATE_HOME": str(tmp_path), "ROS_LOG_DIR": str(tmp_path / "log")},
    )
    said = [line.removeprefix("[orchestra] ") for line in run.stdout.splitlines() + run.stderr.splitlines()]
    expected = ["on_exit 3 ready True", "second frozen", "first inside", "shutting down"]
    assert [line for line in said if line in expected] == expected, run.stdout + run.stderr
    assert "io ready" in said
    assert "from a coroutine" in said
    assert run.returncode == 0
