"""Launch files in Python, run for real: events, timers, and code that decides during the run."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

    from .conftest import Command

_EVENTS = """
from launch import Event, EventHandler, LaunchDescription
from launch.actions import *
from launch.event_handlers import *
from launch.events import Shutdown
from launch.substitutions import LocalSubstitution

class Own(Event):
    name = 'own'

def count(context):
    n = int(context.launch_configurations['n'])
    context.launch_configurations['n'] = str(n + 1)  # is forgotten: each time begins where it was written
    return [LogInfo(msg=f'counted {n}'), TimerAction(period=0.1, actions=[LogInfo(msg='a little later'), EmitEvent(event=Own())])]

def generate_launch_description():
    first = ExecuteProcess(cmd=['sh', '-c', 'echo up; exit 3'], name='first')
    def ended(event, context):
        assert event.action is first and event.process_name == 'first-1' and event.cmd[0] == 'sh' and event.pid > 0
        return [LogInfo(msg=f'status {event.returncode}'), ExecuteProcess(cmd=['sh', '-c', 'echo decided'], name='decided')]
    return LaunchDescription([
        SetLaunchConfiguration('n', '1'),
        RegisterEventHandler(EventHandler(matcher=lambda event: isinstance(event, Own), entities=[LogInfo(msg='own event')])),
        RegisterEventHandler(OnProcessIO(target_action=first, on_stdout=lambda event: [LogInfo(msg='saw ' + event.text.decode().strip())])),
        RegisterEventHandler(OnProcessExit(target_action=first, on_exit=ended)),
        RegisterEventHandler(OnProcessStart(target_action=first, on_start=[LogInfo(msg='started'), OpaqueFunction(function=count)])),
        RegisterEventHandler(OnShutdown(on_shutdown=[LogInfo(msg=['because ', LocalSubstitution('event.reason')])])),
        first,
        TimerAction(period=2, actions=[EmitEvent(event=Shutdown(reason='time is up'))]),
    ])
"""


@pytest.mark.conforms("4.8 on_exit", "4.12 after an end", "4.12 computed")
def test_handlers_and_functions_decide_during_the_run(orchestra: Command, folder: Path) -> None:
    (folder / "events.launch.py").write_text(_EVENTS)
    ran = orchestra("launch", "events.launch.py")
    assert ran.returncode == 0, ran.stderr
    told = [line.removeprefix("[orchestra] ") for line in ran.stderr.splitlines()]
    for line in ("started", "saw up", "status 3", "counted 1", "a little later", "own event"):
        assert told.count(line) == 1, ran.stderr
    assert (
        told.index("started")
        < told.index("counted 1")
        < told.index("a little later")
        < told.index("own event")
    )
    assert "because time is up" in told
    assert "[decided] decided" in ran.stdout


_AGAIN = """
from launch import LaunchDescription
from launch.actions import *
from launch.event_handlers import OnProcessExit
from launch_ros.actions import Node

runs = []

def node():
    return Node(package='demo', executable='talker', name='worn', on_exit=again)

def again(event, context):
    runs.append(event.returncode)
    return node() if len(runs) < 3 else Shutdown(reason=f'worn out: {runs}')

def generate_launch_description():
    return LaunchDescription([node()])
"""


def test_a_node_that_a_handler_starts_again_keeps_its_name_without_a_warning(
    orchestra: Command, folder: Path, prefix: Path
) -> None:
    (folder / "again.launch.py").write_text(_AGAIN)
    ran = orchestra("launch", "again.launch.py", AMENT_PREFIX_PATH=str(prefix))
    assert "shut down: worn out: [0, 0, 0]" in ran.stderr
    assert "warning" not in ran.stderr


@pytest.mark.conforms("4.1 7")
def test_code_that_fails_during_the_run_ends_it_with_the_place(orchestra: Command, folder: Path) -> None:
    (folder / "broken.launch.py").write_text(
        _EVENTS.replace("n = int(context.launch_configurations['n'])", "n = undefined_name")
    )
    ran = orchestra("launch", "broken.launch.py")
    assert ran.returncode == 1, ran.stderr
    assert "there is no name 'undefined_name' here" in ran.stderr
    assert "broken.launch.py:12" in ran.stderr


_FILES = """
import tempfile
from launch import LaunchDescription
from launch.actions import *
from launch.event_handlers import *

def written(text):
    with tempfile.NamedTemporaryFile('w', delete=False, suffix='.txt') as file:
        file.write(text)
    return file.name

def generate_launch_description():
    first = ExecuteProcess(cmd=['cat', written('first')], name='first')
    def more(event, context):
        return [ExecuteProcess(cmd=['cat', written('second')], name='second')]
    return LaunchDescription([first, RegisterEventHandler(OnProcessExit(target_action=first, on_exit=more))])
"""


@pytest.mark.conforms("D37")
def test_temporary_files_of_launch_files_are_part_of_the_run(
    orchestra: Command, folder: Path, home: Path, tmp_path: Path
) -> None:
    (folder / "files.launch.py").write_text(_FILES)
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    ran = orchestra("launch", "files.launch.py", TMPDIR=str(elsewhere))
    assert ran.returncode == 0, ran.stderr
    assert {"[first] first", "[second] second"} <= set(ran.stdout.splitlines())
    assert not list(elsewhere.iterdir())
    (run,) = (home / "runs").iterdir()
    assert sorted(file.read_text() for file in (run / "files").iterdir()) == ["first", "second"]


def test_a_plan_names_temporary_files_as_every_plan_does_and_leaves_none(
    orchestra: Command, folder: Path, tmp_path: Path
) -> None:
    (folder / "files.launch.py").write_text(_FILES)
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    plans = [
        orchestra("plan", "files.launch.py", "--format", "json", TMPDIR=str(elsewhere)) for _ in range(2)
    ]
    assert plans[0].stdout == plans[1].stdout
    assert '"${run}/files/tmp0001.txt"' in plans[0].stdout
    assert not list(elsewhere.iterdir())


def test_with_debug_the_calls_inside_libraries_are_told_too(orchestra: Command, folder: Path) -> None:
    (folder / "broken.launch.py").write_text("import json\njson.loads('{')\n")
    plain, debug = orchestra("launch", "broken.launch.py"), orchestra("launch", "broken.launch.py", "-d")
    assert (plain.returncode, debug.returncode) == (2, 2)
    assert "broken.launch.py:2:1: error: JSONDecodeError" in plain.stderr
    assert "decoder.py" not in plain.stderr
    assert "decoder.py" in debug.stderr


_CANCELLED = """
from launch import LaunchDescription
from launch.actions import *
from launch.event_handlers import *

def generate_launch_description():
    late = TimerAction(period=30.0, actions=[LogInfo(msg='too late'), Shutdown(reason='too late')])
    outer = TimerAction(period=29.0, actions=[TimerAction(period=1.0, actions=[LogInfo(msg='inner')])])
    early = TimerAction(period=0.2, actions=[LogInfo(msg='early')])
    unwanted = TimerAction(period=0.1, actions=[LogInfo(msg='unwanted')])
    again = TimerAction(period=0.1, actions=[LogInfo(msg='again')])
    def visited(context):
        unwanted.cancel()
    def ended(event, context):
        own = TimerAction(period=0.1, actions=[LogInfo(msg='own')])
        for timer in (late, outer, early, again):
            timer.cancel()
            timer.cancel()
        return [LogInfo(msg='cancelled'), own, again]
    program = ExecuteProcess(cmd=['sleep', '1'], on_exit=ended)
    return LaunchDescription([late, outer, early, unwanted, OpaqueFunction(function=visited), program])
"""


def test_a_timer_that_code_cancels_goes_off_no_more(orchestra: Command, folder: Path) -> None:
    (folder / "cancelled.launch.py").write_text(_CANCELLED)
    ran = orchestra("launch", "cancelled.launch.py")
    assert ran.returncode == 0, ran.stderr
    told = [line.removeprefix("[orchestra] ") for line in ran.stderr.splitlines()]
    assert [line for line in told if line in _TIMED] == ["early", "cancelled", "own"], ran.stderr


_TIMED = ("early", "cancelled", "own", "again", "unwanted", "inner", "too late")
