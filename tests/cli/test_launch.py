"""`orchestra launch` and `orchestra run`, as far as the command line decides: what is handed over, shown and refused."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from subprocess import CompletedProcess
from typing import TYPE_CHECKING

import pytest

from orchestra.plan import codec

if TYPE_CHECKING:
    from pathlib import Path

Command = Callable[..., CompletedProcess[str]]

_GREET = """\
launch:
  - arg: {name: who, default: world, choices: [world, moon], description: whom to greet}
  - arg: {name: how}
  - executable: {cmd: "echo $(var how) $(var who)", name: greet, output: log}
"""


@pytest.fixture(autouse=True)
def _file(folder: Path) -> None:
    (folder / "greet.launch.yaml").write_text(_GREET)


def _run_folder(home: Path) -> Path:
    (run,) = (home / "runs").iterdir()
    return run


def test_a_description_is_run_to_its_end(orchestra: Command, home: Path) -> None:
    found = orchestra("launch", "greet.launch.yaml", "how:=hi", "who:=moon")
    assert found.returncode == 0
    run = _run_folder(home)
    assert run.name.endswith("-greet")
    assert (run / "logs" / "greet.log").read_text() == "hi moon\n"
    plan = codec.loads((run / "plan.json").read_bytes())
    assert [process.command for process in plan.processes] == [("echo", "hi", "moon")]


def test_a_warning_that_cannot_be_told_holds_up_no_run(folder: Path, home: Path) -> None:
    """A robot starts also where the disk is full to which its log would go."""
    (folder / "warned.launch.yaml").write_text(
        "launch: [include: {file: greet.launch.yaml, arg: [{name: how, value: hi}, {name: nobody, value: x}]}]"
    )
    with open("/dev/full", "w") as full:  # noqa: PTH123 - it is no file
        done = subprocess.run(
            [sys.executable, "-m", "orchestra", "launch", "warned.launch.yaml"],
            cwd=folder,
            env={**os.environ, "ORCHESTRA_HOME": str(home)},
            stdin=subprocess.DEVNULL,
            stderr=full,
            check=False,
            timeout=60,
        )
    assert done.returncode == 0
    assert (_run_folder(home) / "logs" / "greet.log").read_text() == "hi world\n"


def test_a_run_has_the_name_that_it_is_given(orchestra: Command, home: Path) -> None:
    assert orchestra("launch", "greet.launch.yaml", "how:=hi", "--name", "my / run").returncode == 0
    assert _run_folder(home).name.endswith("-my_run")


@pytest.mark.conforms("5.1 --show-all-subprocesses-output")
@pytest.mark.parametrize(
    ("words", "shown"), [((), False), (("-a",), True), (("--show-all-subprocesses-output",), True)]
)
def test_output_that_only_goes_to_files_can_be_shown(
    orchestra: Command, words: tuple[str, ...], shown: bool
) -> None:
    found = orchestra("launch", "greet.launch.yaml", "how:=hi", *words)
    assert found.returncode == 0
    assert ("hi world" in found.stdout) is shown


@pytest.mark.conforms("4.10 OVERRIDE_LAUNCH_PROCESS_OUTPUT")
@pytest.mark.parametrize(
    ("word", "words", "shown"),
    [("own_log", (), False), ("screen", (), True), ("", (), False), ("log", ("-a",), True)],
)
def test_the_environment_may_say_what_is_shown(
    orchestra: Command, word: str, words: tuple[str, ...], shown: bool
) -> None:
    found = orchestra("launch", "greet.launch.yaml", "how:=hi", *words, OVERRIDE_LAUNCH_PROCESS_OUTPUT=word)
    assert found.returncode == 0
    assert ("hi world" in found.stdout) is shown


def test_an_output_that_there_is_not_is_a_mistake(orchestra: Command, home: Path) -> None:
    found = orchestra("launch", "greet.launch.yaml", "how:=hi", OVERRIDE_LAUNCH_PROCESS_OUTPUT="scren")
    assert (found.returncode, found.stdout) == (2, "")
    assert "OVERRIDE_LAUNCH_PROCESS_OUTPUT" in found.stderr
    assert "'scren'" in found.stderr
    assert not home.exists()


@pytest.mark.conforms("5.1 --debug", "4.10 own messages")
@pytest.mark.parametrize("words", [(), ("-d",), ("--debug",)])
def test_messages_of_level_debug_are_for_who_asks(
    orchestra: Command, folder: Path, words: tuple[str, ...]
) -> None:
    (folder / "log.launch.yaml").write_text(
        "launch:\n  - timer: {period: 0.0, children: [{log: {message: deep, level: debug}}]}\n"
        "  - executable: {cmd: sleep 0.5, name: nap}\n"
    )
    found = orchestra("launch", "log.launch.yaml", *words)
    assert found.returncode == 0
    assert ("deep" in found.stderr) is bool(words)


@pytest.mark.conforms("D29", "5.2 exit status")
@pytest.mark.parametrize(
    ("words", "status"), [((), 0), (("--fail-on", "required"), 0), (("--fail-on", "any"), 1)]
)
def test_whose_failure_counts(orchestra: Command, folder: Path, words: tuple[str, ...], status: int) -> None:
    (folder / "fail.launch.yaml").write_text("launch:\n  - executable: {cmd: 'false', name: fails}\n")
    found = orchestra("launch", "fail.launch.yaml", *words)
    assert found.returncode == status
    assert "fails" in found.stderr.splitlines()[-1]


@pytest.mark.conforms("4.1 7", "5.2 exit status")
def test_what_is_wrong_is_told_and_nothing_is_started(orchestra: Command, home: Path) -> None:
    found = orchestra("launch", "greet.launch.yaml", "who:=mars")
    assert (found.returncode, found.stdout) == (2, "")
    assert "greet.launch.yaml:3:" in found.stderr  # the required argument
    assert "command line:1:" in found.stderr  # no such choice
    assert "2 errors" in found.stderr
    assert not home.exists()


def test_problems_can_be_had_as_json(orchestra: Command) -> None:
    found = orchestra("launch", "greet.launch.yaml", "--format", "json")
    assert (found.returncode, found.stdout) == (2, "")
    assert [problem["code"] for problem in json.loads(found.stderr)] == ["ORC022"]


@pytest.mark.parametrize("name", ["--name", "-n"])
def test_a_flag_that_looks_like_one_that_only_shows_is_still_a_run(
    orchestra: Command, home: Path, name: str
) -> None:
    """What `orchestra.__main__` guesses before it forks decides nothing: `-p` here is a value."""
    words = ["--name=-p"] if name == "--name" else ["-n"]
    assert orchestra("launch", "greet.launch.yaml", "how:=hi", *words).returncode == 0
    assert _run_folder(home)


@pytest.mark.conforms("D29", "5.2 exit status")
@pytest.mark.parametrize(
    ("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)]
)
def test_a_signal_ends_the_run_with_its_status(
    folder: Path, home: Path, number: signal.Signals, status: int
) -> None:
    (folder / "wait.launch.yaml").write_text(
        "launch:\n  - executable: {cmd: sh -c 'echo up; exec sleep 60'}\n"
    )
    with subprocess.Popen(
        [sys.executable, "-m", "orchestra", "launch", "wait.launch.yaml"],
        cwd=folder,
        env={**os.environ, "ORCHESTRA_HOME": str(home)},
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    ) as run:
        assert run.stdout
        assert any("up" in line for line in run.stdout)
        run.send_signal(number)
        assert run.wait(30) == status


@pytest.mark.parametrize(
    "arguments",
    [
        (),
        ("--ros-args", "-p", "rate:=2.0", "-r", "__ns:=/r1"),
        ("--help", "-s", "-p", "--print"),
        ("--name", "x", "--", "-h", "a b", "$HOME", ""),
    ],
)
def test_run_gives_the_node_its_arguments_unchanged(
    orchestra: Command, prefix: Path, arguments: tuple[str, ...]
) -> None:
    found = orchestra("run", "demo", "echo", *arguments, AMENT_PREFIX_PATH=str(prefix))
    assert found.returncode == 0
    assert [line.partition("<")[2] for line in found.stdout.splitlines() if "<" in line] == [
        f"{word}>" for word in arguments
    ]


def test_run_puts_a_prefix_before_the_command(orchestra: Command, prefix: Path) -> None:
    found = orchestra(
        "run", "--prefix", "env MARK=5 sh -x", "demo", "echo", "hi", AMENT_PREFIX_PATH=str(prefix)
    )
    assert found.returncode == 0
    assert "<hi>" in found.stdout
    assert "+ echo" in found.stdout + found.stderr


def test_run_suggests_what_was_meant(orchestra: Command, prefix: Path) -> None:
    found = orchestra("run", "demo", "ehco", AMENT_PREFIX_PATH=str(prefix))
    assert (found.returncode, found.stdout) == (2, "")
    assert "did you mean 'echo'?" in found.stderr
