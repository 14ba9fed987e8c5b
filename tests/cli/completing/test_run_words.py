"""Names of runs and processes at the cursor."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from orchestra import events
from orchestra.cli.completing.command_line import candidates
from orchestra.supervise.runs import identity
from orchestra.supervise.runs.directory import create, state_folder

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from orchestra.supervise.runs.directory import RunDirectory


@pytest.fixture
def run(home: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[RunDirectory]:
    monkeypatch.setenv("ORCHESTRA_HOME", str(home))
    started = create(state_folder() / "runs", identity.identity("mark", "two_robots", "a.yaml", os.getpid()))
    found = [
        events.Event(1.0, 1.0, "process_waiting", name)
        for name in ("/simulation", "/robot1/ekf", "/robot2/ekf", "bag")
    ]
    started.events.write_text("".join(events.dumps(event) + "\n" for event in found))
    yield started
    started.release()


def _words(*words: str) -> list[str]:
    *before, begun = words
    return [item.word for item in candidates(before, begun)]


@pytest.mark.parametrize("command", ["start", "stop", "restart", "logs", "events", "attach"])
def test_processes_of_the_run(run: RunDirectory, command: str) -> None:
    del run
    assert _words(command, "") == ["simulation", "robot1/ekf", "robot2/ekf", "bag", "robot1/", "robot2/"]
    assert _words(command, "rob") == ["robot1/ekf", "robot2/ekf", "robot1/", "robot2/"]
    assert _words(command, "bag", "b") == []


def test_a_signal_comes_before_processes(run: RunDirectory) -> None:
    del run
    assert "SIGUSR1" in _words("signal", "SIGU")
    assert _words("signal", "SIGUSR1", "b") == ["bag"]


@pytest.mark.parametrize("command", ["ps", "logs", "stop", "down", "attach"])
def test_names_of_runs(run: RunDirectory, command: str) -> None:
    del run
    assert _words(command, "--run", "") == ["two_robots"]
    assert _words(command, "--run=t") == ["--run=two_robots"]
    assert _words("launch", "--name", "") == []


def test_where_no_run_has_been(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ORCHESTRA_HOME", str(home))
    assert _words("stop", "") == []
    assert _words("ps", "--run", "") == []
