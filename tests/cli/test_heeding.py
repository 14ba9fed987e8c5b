"""A command that is ended leaves no temporary files of launch files' code behind, nor programs."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING

import pytest

from tests.supervise.plans import assert_ended

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path
    from subprocess import Popen

_STATUS = {signal.SIGINT: 130, signal.SIGTERM: 143, signal.SIGHUP: 129}
_FILE = """\
import subprocess, sys, tempfile, time
from launch import LaunchDescription

def generate_launch_description():
    tempfile.NamedTemporaryFile(delete=False).close()
    started = subprocess.Popen(["sleep", "600"])
    print(f"here {started.pid}", file=sys.stderr, flush=True)
    while True:  # a signal between a look for signals and the call of the system is looked for after that
        time.sleep(0.05)
"""
_STUBBORN = """\
import signal, sys, time
from orchestra.cli import heeding

heeding._PATIENCE = 0.2
signal.signal(signal.SIGHUP, signal.SIG_IGN)
with heeding.heeded():
    told = "here"
    while True:
        try:
            print(told, file=sys.stderr, flush=True)
            while True:
                time.sleep(0.05)
        except BaseException as error:
            told = error
"""
_LEAVING = """\
import atexit, os, signal, sys, threading, time
from orchestra.cli import heeding

heeding._PATIENCE = 0.2
print("here", file=sys.stderr, flush=True)
try:
    with heeding.heeded():
        os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(60)
except heeding.EndedError as error:
    LEFT
    sys.exit(error.status)
"""


@contextmanager
def _begun(folder: Path, *words: str) -> Iterator[tuple[Popen[str], list[str]]]:
    """Start a program; yield it, and the words of the line with which it tells that it is there."""
    (folder / "temporary").mkdir()
    own = {"TMPDIR": f"{folder}/temporary", "ORCHESTRA_HOME": f"{folder}/home"}
    with subprocess.Popen(
        [sys.executable, *words],
        cwd=folder,
        env={**os.environ, **own},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    ) as begun:
        assert begun.stderr is not None
        try:
            yield begun, begun.stderr.readline().split()
        finally:
            begun.kill()


@pytest.mark.parametrize("number", _STATUS, ids=lambda number: number.name)
@pytest.mark.parametrize(
    "words", [("plan",), ("check",), ("launch",), ("launch", "--show-args")], ids=" ".join
)
def test_nothing_is_left_by_what_is_ended(
    folder: Path, words: tuple[str, ...], number: signal.Signals
) -> None:
    (folder / "a.launch.py").write_text(_FILE)
    with _begun(folder, "-m", "orchestra", *words, "a.launch.py") as (command, (here, pid)):
        assert here == "here"
        command.send_signal(number)
        if number != signal.SIGINT:
            command.send_signal(number)  # as timeout(1) does
        assert command.wait(60) == _STATUS[number]
    assert not [*(folder / "temporary").iterdir()]
    assert_ended({int(pid)})


def test_what_code_makes_of_it_delays_the_end_for_a_while(folder: Path) -> None:
    with _begun(folder, "-c", _STUBBORN) as (command, _):
        command.send_signal(signal.SIGTERM)
        assert command.wait(60) == _STATUS[signal.SIGTERM]


@pytest.mark.parametrize(
    "left",
    [
        pytest.param(
            "atexit.register(os.kill, os.getpid(), signal.SIGTERM)", id="another signal at its very end"
        ),
        pytest.param("threading.Thread(target=time.sleep, args=(600,)).start()", id="a thread"),
    ],
)
def test_what_comes_at_its_end_changes_nothing(folder: Path, left: str) -> None:
    with _begun(folder, "-c", _LEAVING.replace("LEFT", left)) as (command, _):
        assert command.wait(60) == _STATUS[signal.SIGTERM]


def test_only_what_is_not_ignored_ends_it(folder: Path) -> None:
    with _begun(folder, "-c", _STUBBORN.replace("0.2", "600")) as (command, _):
        assert command.stderr is not None
        command.send_signal(signal.SIGHUP)
        command.send_signal(signal.SIGTERM)
        assert command.stderr.readline() == "15\n"


def test_a_run_that_cannot_begin_leaves_no_files(folder: Path) -> None:
    (folder / "a.launch.py").write_text(
        _FILE.replace("while True:", "started.kill()\n    while started.wait() > 0:")
        + "    return LaunchDescription()\n"
    )
    (folder / "home").write_text("a file, no folder")
    with _begun(folder, "-m", "orchestra", "launch", "a.launch.py") as (command, _):
        assert command.wait(60) == 1
    assert not [*(folder / "temporary").iterdir()]
