"""What the launch language says of whole runs, asked of real ones: output, ends, restarts, shells."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest

from tests.conformance.marks import conforming

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path
    from subprocess import CompletedProcess

    from .conftest import Command

_PYTHON = """
from launch import LaunchDescription
from launch.actions import *
from launch.event_handlers import *

def generate_launch_description():
    process = ExecuteProcess(cmd=['printf', 'out\\\\nrest'], name='p', on_exit=[LogInfo(msg='on_exit')])
    return LaunchDescription([
        RegisterEventHandler(OnProcessExit(target_action=process, on_exit=[LogInfo(msg='older')])),
        RegisterEventHandler(OnProcessExit(target_action=process, on_exit=[LogInfo(msg='newer')])),
        process,
    ])
"""


class Run:
    """A run that is over."""

    def __init__(self, done: CompletedProcess[str], folder: Path) -> None:
        self.status = done.returncode
        self.said = done.stderr
        self.shown = done.stdout.splitlines()
        self.folder = folder

    @property
    def events(self) -> list[dict[str, Any]]:
        """What happened."""
        return [json.loads(line) for line in (self.folder / "events.jsonl").read_text("utf-8").splitlines()]

    def count(self, kind: str) -> int:
        """Return how often something happened."""
        return sum(event["kind"] == kind for event in self.events)

    def log(self, name: str) -> str:
        """Return what a process wrote."""
        return (self.folder / "logs" / f"{name}.log").read_text("utf-8")

    def order(self, *texts: str) -> bool:
        """Tell whether messages came in this order."""
        places = [self.said.find(f"[orchestra] {text}\n") for text in texts]
        return -1 not in places and places == sorted(places)


def _ending(run: Run) -> Any:
    return run.events[-1]["data"]


# Row -> launch file, what is looked at, what it is.
FACTS: dict[str, tuple[str, Callable[[Run], Any], Any]] = {
    "7 6": (_PYTHON, lambda run: [run.status, run.order("on_exit", "newer", "older")], [0, True]),
    "7 7": (_PYTHON, lambda run: [run.log("p"), "[p] rest" in run.shown], ["out\nrest", True]),
    "7 8": (
        "launch: [{executable: {cmd: sh -c 'exit 3', name: p}}]",
        lambda run: [run.status, "p (exit code 3)" in run.said],
        [0, True],
    ),
    "4.8 log": (
        "launch: [{executable: {cmd: sh -c 'exit 3', name: p}}]",
        lambda run: [event["data"]["code"] for event in run.events if event["kind"] == "process_ended"],
        [3],
    ),
    "7 9": (
        "launch: [{executable: {cmd: sh -c 'exit 3', name: p, on_exit: shutdown}}, {executable: {cmd: sleep 60, name: s}}]",
        lambda run: [run.status, [event["data"]["signal"] for event in run.events if event["kind"] == "signal_sent"]],
        [3, ["SIGINT"]],
    ),
    "7 10": (
        "launch: [{executable: {cmd: \"sh -c 'trap : INT TERM; while :; do sleep 0.1; done'\", name: p, "
        "sigterm_timeout: 0.3, sigkill_timeout: 0.3}}, {timer: {period: 0.5, children: [{shutdown: {}}]}}]",
        lambda run: [run.status, [event["data"]["signal"] for event in run.events if event["kind"] == "signal_sent"]],
        [0, ["SIGINT", "SIGTERM", "SIGKILL"]],
    ),
    "7 12": (
        "launch: [{executable: {cmd: echo $(anon x), name: p, respawn: true, respawn_max_retries: 2}}]",
        lambda run: [run.status, run.count("process_running")],
        [0, 3],
    ),
    "4.8 same process": (
        "launch: [{executable: {cmd: \"sh -c 'echo $A $0 $(anon x)'\", name: p, env: [{name: A, value: $(anon y)}], "
        "respawn: true, respawn_max_retries: 2}}]",
        lambda run: [len(run.log("p").splitlines()), len(set(run.log("p").splitlines()))],
        [3, 1],
    ),
    "7 16": (
        "launch: [{executable: {cmd: echo shell $HOME, name: p, shell: true}}]",
        lambda run: run.log("p"),
        "shell /home/robot\n",
    ),
    "4.10 log directory": (
        "launch: [{executable: {cmd: echo a, name: p}}, {executable: {cmd: echo b, name: q, output: own_log}}]",
        lambda run: [run.log("p"), run.log("q"), (run.folder / "plan.json").is_file()],
        ["a\n", "b\n", True],
    ),
    "4.1 6": ("launch: [{log: {message: done}}]", _ending, {"status": 0, "reason": "every process has ended"}),
    "4.9 timeouts": (
        "launch: [{let: {name: sigterm_timeout, value: 0.2}}, {executable: {cmd: \"sh -c 'trap : INT; "
        "while :; do sleep 0.1; done'\", name: p}}, {timer: {period: 0.5, children: [{shutdown: {}}]}}]",
        lambda run: [event["data"]["signal"] for event in run.events if event["kind"] == "signal_sent"],
        ["SIGINT", "SIGTERM"],
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", conforming(FACTS))
def test_a_fact_holds(case: str, orchestra: Command, folder: Path, home: Path) -> None:
    text, view, expected = FACTS[case]
    name = "main.launch.py" if text is _PYTHON else "main.launch.yaml"
    (folder / name).write_text(text)
    done = orchestra("launch", name, HOME="/home/robot")
    (run,) = (home / "runs").iterdir()
    assert view(Run(done, run)) == expected, done.stderr
