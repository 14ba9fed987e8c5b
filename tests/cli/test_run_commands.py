"""The commands that concern runs, each a process of its own, at real runs."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
from typing import TYPE_CHECKING, TypeAlias

import pytest

from orchestra.cli.main import main
from orchestra.values import Restart
from tests.supervise.plans import PATIENCE, after, launched, plan, process, ready_when, wait_for

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path
    from subprocess import CompletedProcess

    from tests.supervise.plans import Launched

    Command: TypeAlias = Callable[..., CompletedProcess[str]]

STEADY = ("polite", "say=up", "linger")
_STREAMS = ("start", "stop", "restart", "signal", "ps", "logs", "events", "down", "attach", "clean")


@pytest.fixture
def inside(home: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Command:
    """Run a command in this process: where many are tried, starting one each time takes too long."""
    monkeypatch.setenv("ORCHESTRA_HOME", str(home))
    monkeypatch.setenv("NO_COLOR", "1")

    def carry_out(*words: str) -> CompletedProcess[str]:
        status = main(words)
        return subprocess.CompletedProcess(words, status, *capsys.readouterr())

    return carry_out


@pytest.fixture
def run(tmp_path: Path) -> Iterator[Launched]:
    """A run in the home of the commands."""
    processes = [
        process("/robot1/ekf", *STEADY, required=True),
        process("/robot1/arm", "say=starting", "linger", ready=ready_when(log="never")),
        process("/robot2/ekf", *STEADY, depends_on=after("/robot1/arm", "ready")),
        process("broken", command=("/no/such/program",)),
        process("bag", "say=[WARN] [17.5] [bag]: full", "complain=oops", "exit=3", restart=Restart("no")),
    ]
    with launched(tmp_path, plan(*processes)) as started:
        started.await_event("process_failed", "bag")
        started.await_line("robot1.ekf", "up")
        started.await_line("robot1.arm", "starting")
        yield started


def test_without_a_run_commands_say_so(inside: Command) -> None:
    listed = inside("ps")
    assert (listed.returncode, listed.stdout, listed.stderr) == (0, "", "no run is alive\n")
    assert inside("ps", "--format", "json").stdout == "[]\n"
    for words in (("stop", "a"), ("start", "a"), ("signal", "INT", "a"), ("down",), ("attach", "a")):
        found = inside(*words)
        assert (found.returncode, found.stdout) == (1, "")
        assert found.stderr == "error: no run is alive; 'orchestra launch' starts one\n"
    for words in (("logs",), ("events",)):
        found = inside(*words)
        assert found.returncode == 1
        assert "there has been no run yet" in found.stderr
    assert inside("stop", "--run", "x", "a").returncode == 2
    assert inside("down", "--all").returncode == 1


def test_ps_shows_how_everything_stands(run: Launched, orchestra: Command) -> None:
    found = orchestra("ps")
    assert (found.returncode, found.stderr) == (0, "")
    head, columns, *rows = found.stdout.splitlines()
    assert re.fullmatch(r"run  by_hand.yaml  up \d.*", head)
    assert columns.split() == ["NAME", "STATE", "PID", "RESTARTS", "UPTIME", "CPU", "MEMORY"]
    pid = str(run.of_kind("process_running", "/robot1/ekf")[0].pid)
    cells = [row.split(maxsplit=7) for row in rows]
    assert cells[0][:4] == ["robot1/ekf", "running", pid, "0"]
    assert re.fullmatch(r"[\d.]+[KM]", cells[0][6])
    assert cells[1][:2] == ["robot1/arm", "running"]
    assert cells[1][7] == "waits for a line of its output that matches 'never'"
    assert cells[2][:7] == ["robot2/ekf", "waiting", "-", "0", "-", "-", "-"]
    assert cells[2][7].startswith("waits for robot1/arm to be ready")
    assert cells[4][:3] == ["bag", "failed", "-"]
    assert cells[4][7] == "exit code 3"
    assert "\x1b[" not in found.stdout
    assert "\x1b[32mrunning" in orchestra("ps", FORCE_COLOR="1", NO_COLOR="").stdout


def test_ps_for_programs(run: Launched, orchestra: Command) -> None:
    (seen,) = json.loads(orchestra("ps", "--format", "json", "--run", "run").stdout)
    assert seen["name"] == "run"
    assert seen["directory"] == str(run.directory)
    assert seen["keeper"] == run.popen.pid
    assert seen["age"] > 0
    first, *_, last = seen["processes"]
    assert first["phase"] == "running"
    assert first["required"]
    assert first["memory"] > 0
    assert first["cpu"] >= 0
    assert (last["phase"], last["ending"], last["memory"]) == ("failed", "exit code 3", None)


def test_ps_tells_of_a_run_that_cannot_be_asked(run: Launched, orchestra: Command) -> None:
    (run.directory / "control.sock").unlink()
    found = orchestra("ps")
    assert (found.returncode, found.stdout) == (1, "")
    assert found.stderr == "error: run: it has no control socket\n"


def test_processes_are_stopped_started_and_restarted(run: Launched, orchestra: Command) -> None:
    found = orchestra("stop", "robot1/ekf")
    assert (found.returncode, found.stdout, found.stderr) == (0, "robot1/ekf: exited (exit code 0)\n", "")
    found = orchestra("stop", "robot1/ekf")
    assert (found.returncode, found.stdout, found.stderr) == (0, "", "robot1/ekf: it does not run\n")
    found = orchestra("start", "/robot1/ekf")
    assert found.returncode == 0
    assert re.fullmatch(r"robot1/ekf: running \(pid \d+\)\n", found.stdout)
    found = orchestra("start", "robot1/ekf", "--format", "json")
    assert json.loads(found.stdout) == {"refused": {"/robot1/ekf": "it runs already"}, "processes": {}}
    assert found.returncode == 0
    assert orchestra("restart", "*/ekf", "--no-wait").returncode == 1  # the other ekf waits
    run.await_event("process_running", "/robot1/ekf", 3)
    found = orchestra("start", "broken")
    assert found.returncode == 1
    assert found.stdout.startswith("broken: failed (")


def test_processes_that_are_not_there_are_a_mistake(run: Launched, inside: Command) -> None:
    del run
    for words in (
        ("stop", "bga"),
        ("logs", "bga"),
        ("events", "bga"),
        ("attach", "bga"),
        ("signal", "INT", "bga"),
    ):
        found = inside(*words)
        assert (found.returncode, found.stdout) == (2, "")
        assert "error: no process is called 'bga'; did you mean 'bag'?" in found.stderr
    assert "there is no signal 'SIGNIX'" in inside("signal", "SIGNIX", "bag").stderr
    found = inside("stop", "--run", "rnu", "bag")
    assert found.returncode == 2
    assert "no run 'rnu' is alive; did you mean 'run'?" in found.stderr


def test_processes_get_signals(run: Launched, orchestra: Command) -> None:
    found = orchestra("signal", "sigurg", "robot1/")
    assert found.returncode == 0
    assert found.stdout.count("signalled (pid ") == 2
    assert orchestra("signal", "usr1", "robot1/arm").returncode == 0
    assert run.await_event("process_ended", "/robot1/arm").data["signal"] == signal.SIGUSR1
    found = orchestra("signal", "10", "bag")
    assert (found.returncode, found.stderr) == (1, "bag: it does not run\n")


def test_a_run_is_ended_and_its_status_told(run: Launched, orchestra: Command) -> None:
    found = orchestra("down")
    last = run.events[-1].data
    assert found.returncode == last["status"] == run.wait()
    assert found.stdout == f"run ended with status {last['status']}: {last['reason']}\n"
    assert not run.everything()


def test_the_logs_of_a_run_that_lives_and_of_one_that_is_over(run: Launched, inside: Command) -> None:
    lines = wait_for(lambda: _lines(inside("logs"), 5), "all lines")
    assert next(line for line in lines if "[bag] " in line).endswith("[WARN] [17.5] [bag]: full")
    assert all(re.match(r"\d\d:\d\d:\d\d\.\d\d\d \[", line) for line in lines)
    assert _texts(inside("logs", "bag")) == ["[WARN] [17.5] [bag]: full", "oops"]
    assert sorted(_texts(inside("logs", "robot1/"))) == ["starting", "up"]
    assert _texts(inside("logs", "bag", "-n", "1")) == ["oops"]
    assert _texts(inside("logs", "bag", "-n", "0")) == []
    assert _texts(inside("logs", "--level", "warn")) == ["[WARN] [17.5] [bag]: full"]
    assert _texts(inside("logs", "bag", "--grep", "o+ps")) == ["oops"]
    assert _texts(inside("logs", "bag", "--since", "1h")) == ["[WARN] [17.5] [bag]: full", "oops"]
    assert _texts(inside("logs", "bag", "--since", "2099-01-01")) == []
    assert "waiting for robot1/arm" in inside("logs", "orchestra").stdout
    record = json.loads(inside("logs", "bag", "--grep", "full", "--format", "json").stdout)
    assert (record["process"], record["severity"], record["stream"]) == ("bag", "warn", "stdout")
    assert "no regular expression" in inside("logs", "--grep", "(").stderr
    assert "0 or more" in inside("logs", "-n", "-1").stderr
    run.send(signal.SIGINT)
    run.wait()
    for words in ((), ("--run", "run"), ("--run", run.directory.name), ("--run", str(run.directory))):
        assert _texts(inside("logs", "bag", *words)) == ["[WARN] [17.5] [bag]: full", "oops"]
    assert "there is no run 'rum'; did you mean 'run'?" in inside("logs", "--run", "rum").stderr


def _lines(found: CompletedProcess[str], least: int) -> list[str]:
    assert found.returncode == 0, found.stderr
    lines = [line for line in found.stdout.splitlines() if "[orchestra]" not in line]
    return lines if len(lines) >= least - 1 else []


def _texts(found: CompletedProcess[str]) -> list[str]:
    assert found.returncode == 0, found.stderr
    return [line.split("] ", 1)[1].strip() for line in found.stdout.splitlines()]


def test_bytes_that_are_no_text_come_out_of_the_logs_as_they_went_in(
    tmp_path: Path, orchestra: Command, home: Path
) -> None:
    del orchestra
    raw = ("sh", "-c", r"printf 'caf\351\n'")
    with launched(tmp_path, plan(process("a", command=raw))) as run:
        assert run.wait() == 0
    done = subprocess.run(
        [sys.executable, "-m", "orchestra", "logs", "a"],
        env={**os.environ, "ORCHESTRA_HOME": str(home)},
        capture_output=True,
        timeout=PATIENCE,
        check=True,
    )
    assert done.stdout.endswith(b" caf\xe9\n")


class _Follower:
    """A command that follows a run."""

    def __init__(self, home: Path, *words: str) -> None:
        self.popen = subprocess.Popen(
            [sys.executable, "-m", "orchestra", *words],
            env={**os.environ, "ORCHESTRA_HOME": str(home), "PYTHONUNBUFFERED": "1"},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            text=True,
        )

    def read_until(self, words: str) -> list[str]:
        assert self.popen.stdout is not None
        lines = []
        for line in self.popen.stdout:
            lines.append(line)
            if words in line:
                return lines
        raise AssertionError(f"no {words!r} in {lines}")

    def rest(self) -> str:
        out, _ = self.popen.communicate(timeout=PATIENCE)
        assert self.popen.returncode == 0
        return str(out)


def test_logs_and_events_are_followed_to_the_end_without_looking_again_and_again(
    run: Launched, home: Path, orchestra: Command
) -> None:
    logs = _Follower(home, "logs", "-f", "robot1/ekf")
    events = _Follower(home, "events", "-f", "--format", "json")
    logs.read_until("up")
    events.read_until("process_failed")
    idle = _waits(logs.popen.pid)
    assert orchestra("restart", "robot1/ekf").returncode == 0
    assert len(logs.read_until("up")) >= 1
    assert _waits(logs.popen.pid) - idle < 100
    assert orchestra("down").returncode == 0
    logs.rest()
    kinds = [json.loads(line)["kind"] for line in events.rest().splitlines()]
    assert kinds[-1] == "run_ended"
    assert run.wait() == 0


def _waits(pid: int) -> int:
    """How often a process has given up the processor by itself."""
    with open(f"/proc/{pid}/status") as lines:  # noqa: PTH123
        return next(int(line.split()[1]) for line in lines if line.startswith("voluntary_ctxt_switches"))


def test_the_events_of_a_run(run: Launched, orchestra: Command) -> None:
    written = (run.directory / "events.jsonl").read_text().splitlines()
    shown = orchestra("events", "--format", "json").stdout.splitlines()
    assert shown[: len(written)] == written[: len(shown)]
    told = orchestra("events", "bag")
    assert told.returncode == 0
    kinds = [line.split()[1] for line in told.stdout.splitlines()]
    assert kinds[:3] == ["process_waiting", "process_starting", "process_running"]
    assert kinds[-1] == "process_failed"
    assert re.search(r"process_ended bag pid=\d+ code=3", told.stdout)
    assert orchestra("events", "--since", "2099-01-01").stdout == ""


def test_a_reader_that_goes_away_is_no_fault(run: Launched, home: Path) -> None:
    del run
    done = subprocess.run(
        ["sh", "-c", f'"{sys.executable}" -m orchestra events | head -1'],
        env={**os.environ, "ORCHESTRA_HOME": str(home)},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=True,
    )
    assert "run_started" in done.stdout
    assert done.stderr == ""


@pytest.mark.parametrize("command", _STREAMS)
def test_no_command_of_runs_imports_anything_heavy(command: str, folder: Path, home: Path) -> None:
    words = {"signal": ["INT", "a"], "ps": [], "logs": [], "events": [], "down": [], "clean": []}.get(
        command, ["a"]
    )
    count = (
        f"import json, runpy, sys; sys.argv[1:] = {[command, *words]}\n"
        "try: runpy.run_module('orchestra', run_name='__main__')\n"
        "except SystemExit: pass\n"
        "json.dump(sorted(sys.modules), sys.stderr)"
    )
    done = subprocess.run(
        [sys.executable, "-c", count],
        cwd=folder,
        env={**os.environ, "ORCHESTRA_HOME": str(home)},
        capture_output=True,
        text=True,
        check=True,
        timeout=PATIENCE,
    )
    modules = set(json.loads(done.stderr.splitlines()[-1]))
    assert not modules & {
        "pydantic",
        "pydantic_core._pydantic_core",
        "yaml",
        "rclpy",
        "asyncio",
        "subprocess",
        "importlib.metadata",
    }
    ours = {name for name in modules if name.startswith("orchestra.")}
    assert not {
        name
        for name in ours
        if name.startswith(("orchestra.description", "orchestra.resolve", "orchestra.pipeline"))
    }
    assert len(ours) <= 50
