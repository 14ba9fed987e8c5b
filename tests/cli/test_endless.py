"""Launch files whose code does not come to an end by itself, or asks the user something."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

_ENDLESS = """\
from launch import LaunchDescription
def generate_launch_description():
    print('here', flush=True)
    while True:
        {body}
"""
_QUESTION = """\
from launch import LaunchDescription
from launch.actions import LogInfo
def generate_launch_description():
    return LaunchDescription([LogInfo(msg=input('which robot? '))])
"""
_PATIENCE = 60.0


@contextmanager
def _started(folder: Path, home: Path, *words: str) -> Iterator[subprocess.Popen[str]]:
    with subprocess.Popen(
        [sys.executable, "-m", "orchestra", *words],
        cwd=folder,
        env={**os.environ, "ORCHESTRA_HOME": str(home), "NO_COLOR": "1"},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        try:
            yield process
        finally:
            process.kill()


@pytest.mark.parametrize(
    "body", ["pass", "try: __import__('time').sleep(600)\n        except Exception: pass"]
)
@pytest.mark.parametrize("command", ["plan", "check", "launch"])
def test_an_interruption_ends_it(folder: Path, home: Path, command: str, body: str) -> None:
    (folder / "a.launch.py").write_text(_ENDLESS.format(body=body))
    with _started(folder, home, command, "a.launch.py") as process:
        assert process.stderr is not None
        assert process.stderr.readline() == "here\n"
        process.send_signal(signal.SIGINT)
        _, told = process.communicate(timeout=_PATIENCE)
    assert process.returncode == 130
    assert "Traceback" not in told


@pytest.mark.parametrize(("command", "said"), [("plan", "log 'robot1'"), ("launch", "[orchestra] robot1")])
def test_a_question_is_answered_by_standard_input(folder: Path, home: Path, command: str, said: str) -> None:
    (folder / "a.launch.py").write_text(_QUESTION)
    with _started(folder, home, command, "a.launch.py") as process:
        printed, told = process.communicate("robot1\n", timeout=_PATIENCE)
    assert process.returncode == 0
    assert told.startswith("which robot? ")
    assert said in printed + told


def test_a_question_that_nobody_answers_is_told(folder: Path, home: Path) -> None:
    (folder / "a.launch.py").write_text(_QUESTION)
    with _started(folder, home, "launch", "a.launch.py") as process:
        _, told = process.communicate("", timeout=_PATIENCE)
    assert process.returncode == 2
    assert "a.launch.py:4:43: error: EOFError" in told


@pytest.mark.parametrize(
    "body", ["pass", "try: __import__('time').sleep(600)\n        except BaseException: pass"]
)
def test_a_conversion_has_a_time_limit(folder: Path, home: Path, body: str) -> None:
    (folder / "a.launch.py").write_text(_ENDLESS.format(body=body))
    words = ("convert", "a.launch.py", "--to", "yaml", "--time-limit", "0.5")
    with _started(folder, home, *words) as process:
        out, err = process.communicate(timeout=_PATIENCE)
    assert (process.returncode, out) == (2, "")
    assert "error: the code of a.launch.py takes longer than 0.5 s (--time-limit)" in err
