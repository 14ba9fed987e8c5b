"""Runs that are detached: they outlive the command, the terminal and each other's names."""

from __future__ import annotations

import json
import os
import pty
import signal
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

import pytest

from orchestra.supervise.keeping import proc
from orchestra.supervise.runs import registry
from tests.supervise.plans import PATIENCE, alive, wait_for

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from subprocess import CompletedProcess

    from orchestra.supervise.runs.registry import Run

    Command: TypeAlias = Callable[..., CompletedProcess[str]]

_TALK = """\
launch:
  - executable: {cmd: "sh -c 'echo up; read x; exec sleep 1000'", name: talk, ready: {log: up}}
  - executable: {cmd: sleep 1000, name: sleeper}
"""
_FAIL = """\
launch:
  - executable: {cmd: "sh -c 'exit 7'", name: fails}
  - executable: {cmd: sleep 1000, name: sleeper}
"""
_REQUIRED = """\
launch:
  - executable: {cmd: "sh -c 'echo down; exit 7'", name: fails, required: true, ready: {log: up}}
"""


# The end takes so long that everybody sees the run while it ends.
_SLOW_END = f"""{_REQUIRED}\
  - executable: {{cmd: "sh -c 'trap \\"sleep 0.5; exit\\" INT; echo up; while :; do sleep 0.05; done'", name: lasts}}
"""


@pytest.fixture(autouse=True)
def files(folder: Path, home: Path) -> Iterator[None]:
    """Files to launch; what is left of their runs is killed at the end."""
    for name, text in {
        "talk": _TALK,
        "fail": _FAIL,
        "required": _REQUIRED,
        "slow": _SLOW_END,
    }.items():
        (folder / f"{name}.launch.yaml").write_text(text)
    yield
    for run in registry.living(home / "runs"):
        for pid in (*proc.descendants(run.identity.keeper), run.identity.keeper):
            with suppress(ProcessLookupError):  # they end each other
                os.kill(pid, signal.SIGKILL)


def _only(home: Path) -> Run:
    (run,) = registry.living(home / "runs")
    return run


def test_a_run_is_detached_found_and_ended(orchestra: Command, home: Path, folder: Path) -> None:
    found = orchestra("launch", "--detach", "talk.launch.yaml")
    assert (found.returncode, found.stdout) == (0, "talk\n")
    assert "[orchestra] 2 processes; logs in" in found.stderr
    run = _only(home)
    keeper = run.identity.keeper
    facts = proc.stat(keeper)
    assert facts is not None
    assert facts.session == keeper
    assert {str(Path(f"/proc/{keeper}/fd/{number}").readlink()) for number in (1, 2)} == {
        str(run.directory / "console.log")
    }
    assert str(Path(f"/proc/{keeper}/fd/0").readlink()) == os.devnull
    os.kill(keeper, signal.SIGHUP)
    assert orchestra("ps").stdout.startswith("talk  ")
    ended = orchestra("down")
    assert ended.returncode == 0
    assert ended.stdout.startswith("talk ended with status 0: ")
    assert not alive(keeper)
    console = (run.directory / "console.log").read_text()
    assert "run ended with status 0" in console
    assert "up" not in console.splitlines()
    assert not [path for path in (home / "runs").iterdir() if path != run.directory]
    del folder


def test_waiting_until_everything_is_ready(orchestra: Command, home: Path) -> None:
    found = orchestra("launch", "--detach", "--wait-ready", "--name", "mine", "talk.launch.yaml")
    assert (found.returncode, found.stdout) == (0, "mine\n")
    (seen,) = json.loads(orchestra("ps", "--format", "json").stdout)
    assert [process["phase"] for process in seen["processes"]] == ["ready", "running"]
    again = orchestra("launch", "--detach", "--name", "mine", "talk.launch.yaml")
    assert (again.returncode, again.stdout) == (2, "")
    assert f"a run named 'mine' is alive: {_only(home).directory}" in again.stderr
    assert orchestra("down", "--run", "mine").returncode == 0


def test_what_is_never_ready_is_told_and_the_run_goes_on(orchestra: Command, home: Path) -> None:
    found = orchestra("launch", "--detach", "--wait-ready", "fail.launch.yaml")
    assert (found.returncode, found.stdout) == (1, "fail\n")
    assert (
        "error: never ready: fails (exit code 7); the run goes on: 'orchestra down --run fail'"
        in found.stderr
    )
    assert _only(home).name == "fail"
    assert orchestra("down").returncode == 0


@pytest.mark.parametrize(
    ("words", "status", "message"),
    [
        (("nothing.yaml",), 2, "there is no launch file nothing.yaml"),
        (("talk.launch.yaml", "x:=1"), 2, "x"),
        (("--wait-ready", "required.launch.yaml"), 7, "required process fails failed (exit code 7)"),
        (("--wait-ready", "slow.launch.yaml"), 7, "required process fails failed (exit code 7)"),
    ],
)
def test_what_goes_wrong_before_is_shown_with_its_status(
    orchestra: Command, home: Path, words: tuple[str, ...], status: int, message: str
) -> None:
    found = orchestra("launch", "--detach", *words)
    assert (found.returncode, found.stdout) == (status, "")
    assert message in found.stderr
    assert not registry.living(home / "runs")
    assert not [path.name for path in (home / "runs").iterdir() if path.name.startswith(".")]


def test_wait_ready_wants_detach(orchestra: Command) -> None:
    found = orchestra("launch", "--wait-ready", "talk.launch.yaml")
    assert found.returncode == 2
    assert "--wait-ready goes with --detach" in found.stderr


def test_several_runs_have_names_of_their_own(orchestra: Command, home: Path) -> None:
    names = [orchestra("launch", "--detach", "talk.launch.yaml").stdout for _ in range(2)]
    assert names == ["talk\n", "talk-2\n"]
    assert orchestra("ps").stdout.count("talk.launch.yaml") == 2
    for words in (("stop", "talk"), ("logs",), ("down",)):
        found = orchestra(*words)
        assert found.returncode == 2
        assert "several runs are alive; say which with --run: talk, talk-2" in found.stderr
    assert orchestra("stop", "--run", "talk-2", "sleeper").returncode == 0
    phases = {
        run["name"]: run["processes"][1]["phase"]
        for run in json.loads(orchestra("ps", "--format", "json").stdout)
    }
    assert phases == {"talk": "running", "talk-2": "exited"}
    ended = orchestra("down", "--all")
    assert ended.returncode == 0
    assert ended.stdout.count("ended with status 0") == 2
    assert not registry.living(home / "runs")


def test_a_detached_run_outlives_the_terminal(folder: Path, home: Path, orchestra: Command) -> None:
    pid, terminal = pty.fork()
    if not pid:
        os.chdir(folder)
        os.environ["ORCHESTRA_HOME"] = str(home)
        words = [sys.executable, "-m", "orchestra", "launch", "--detach", "talk.launch.yaml"]
        os.execv(sys.executable, words)  # noqa: S606
    shown = b""
    while b"talk\r\n" not in shown:
        shown += os.read(terminal, 4096)
    assert os.waitpid(pid, 0)[1] == 0
    os.close(terminal)
    run = _only(home)
    assert all(
        not str(Path(f"/proc/{pid}/fd/{number}").readlink()).startswith("/dev/pts/")
        for pid in (run.identity.keeper, run.identity.supervisor)
        for number in (0, 1, 2)
    )
    assert orchestra("restart", "sleeper").returncode == 0
    assert orchestra("down").returncode == 0


def test_ctrl_c_while_it_begins_ends_it(folder: Path, home: Path) -> None:
    (folder / "slow.launch.yaml").write_text(
        "launch: [{executable: {cmd: sleep 1000, name: slow, ready: {log: never}}}]\n"
    )
    command = subprocess.Popen(
        [sys.executable, "-m", "orchestra", "launch", "--detach", "--wait-ready", "slow.launch.yaml"],
        cwd=folder,
        env={**os.environ, "ORCHESTRA_HOME": str(home)},
        stdin=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    run = wait_for(lambda: registry.living(home / "runs"), "the run")[0]
    wait_for((run.directory / "console.log").exists, "its begin")
    command.send_signal(signal.SIGINT)
    _, told = command.communicate(timeout=PATIENCE)
    assert command.returncode == 130
    assert "stopped by SIGINT" in told
    assert not alive(run.identity.keeper)


def test_one_node_can_be_detached_too(orchestra: Command, prefix: Path, home: Path) -> None:
    (prefix / "lib" / "demo" / "sleeper").write_text("#!/bin/sh\nexec sleep 1000\n")
    (prefix / "lib" / "demo" / "sleeper").chmod(0o755)
    found = orchestra("run", "--detach", "demo", "sleeper", "--detach", AMENT_PREFIX_PATH=str(prefix))
    assert (found.returncode, found.stdout) == (0, "sleeper\n"), found.stderr
    assert _only(home).name == "sleeper"
    assert orchestra("down").returncode == 0
