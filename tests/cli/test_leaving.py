"""What code of launch files leaves running ends with a command that starts nothing."""

from __future__ import annotations

import os
from collections.abc import Callable
from subprocess import CompletedProcess
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

Command = Callable[..., CompletedProcess[str]]

_FILE = """\
import subprocess
import threading
import time
from launch import LaunchDescription
{code}

def generate_launch_description():
    return LaunchDescription([])
"""
LEFT = {
    "a program": "started = subprocess.Popen(['sleep', '600']); print(started.pid)",
    "a program that has lost its parent": "subprocess.run('sleep 600 & echo $!', shell=True)",
    "a program in a session of its own": (
        "started = subprocess.Popen(['sleep', '600'], start_new_session=True); print(started.pid)"
    ),
}


@pytest.mark.parametrize("command", ["plan", "check"])
@pytest.mark.parametrize("code", LEFT.values(), ids=list(LEFT))
def test_programs_are_killed(orchestra: Command, folder: Path, command: str, code: str) -> None:
    (folder / "a.launch.py").write_text(_FILE.format(code=code))
    found = orchestra(command, "a.launch.py")
    assert found.returncode == 0
    pid = int(found.stderr.split()[0])
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


def test_threads_are_not_waited_for(orchestra: Command, folder: Path) -> None:
    (folder / "a.launch.py").write_text(
        _FILE.format(code="threading.Thread(target=time.sleep, args=(600,)).start()")
    )
    found = orchestra("plan", "a.launch.py", "--format", "json")
    assert found.returncode == 0
    assert found.stdout.endswith("}\n")
