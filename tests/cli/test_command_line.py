"""The outermost layer: help, version, mistakes on the command line, and what all of that imports."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from importlib.metadata import version
from typing import TYPE_CHECKING

import pytest

from orchestra.__main__ import starts_processes
from orchestra.cli.commands import COMMANDS

if TYPE_CHECKING:
    from pathlib import Path


Command = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture
def orchestra(orchestra_quickly: Command) -> Command:
    """Run the command; what starts nothing, in this process."""
    return orchestra_quickly


_HEAVY = {
    "pydantic",
    "pydantic_core",
    "pydantic_core._pydantic_core",
    "yaml",
    "rclpy",
    "jinja2",
    "mujoco",
    "numpy",
    "importlib.metadata",
}
_MODULES = """
import json, runpy, sys
sys.argv[1:] = {words}
try:
    runpy.run_module("orchestra", run_name="__main__")
except SystemExit:
    pass
json.dump(sorted(sys.modules), sys.stderr)
"""


def test_help_lists_every_command(orchestra_beside: Command) -> None:
    found = orchestra_beside("--help")
    assert (found.returncode, found.stderr) == (0, "")
    for name, command in COMMANDS.items():
        assert f"{name} " in found.stdout
        assert command.summary in found.stdout


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_explains_itself(orchestra: Command, name: str) -> None:
    found = orchestra(name, "--help")
    assert (found.returncode, found.stderr) == (0, "")
    assert f"usage: orchestra {name}" in found.stdout


def test_a_command_has_the_other_name_that_the_ros_2_tools_give_it(orchestra_beside: Command) -> None:
    assert orchestra_beside("wtf", "--help").stdout.startswith("usage: orchestra doctor")


def test_version(orchestra_beside: Command) -> None:
    assert orchestra_beside("--version").stdout == f"orchestra {version('orchestra')}\n"


@pytest.mark.parametrize(
    ("words", "message", "hint"),
    [
        ((), "a command is missing", "orchestra --help"),
        (("lanch",), "there is no command 'lanch'; did you mean 'launch'?", "orchestra --help"),
        (("launch",), "a launch file is missing", "orchestra launch --help"),
        (("launch", "--nonsense", "x"), "unrecognized arguments: --nonsense", "orchestra launch --help"),
        (("launch", "--show", "x"), "unrecognized arguments: --show", "orchestra launch --help"),
        (("launch", "nowhere.yaml"), "there is no launch file nowhere.yaml", "orchestra launch --help"),
        (("plan",), "a launch file is missing", "orchestra plan --help"),
        (("plan", "--format", "xml", "x"), "invalid choice: 'xml'", "orchestra plan --help"),
        (("check",), "a file or folder is missing", "orchestra check --help"),
        (("check", "nowhere"), "there is no file, folder or package nowhere", "orchestra check --help"),
        (("run", "demo"), "a package and an executable are wanted", "orchestra run --help"),
        (("schema", "nothing"), "invalid choice: 'nothing'", "orchestra schema --help"),
    ],
)
def test_a_mistake_is_one_line_and_a_hint(
    orchestra: Command, words: tuple[str, ...], message: str, hint: str
) -> None:
    found = orchestra(*words)
    assert (found.returncode, found.stdout) == (2, "")
    told, helped = found.stderr.splitlines()
    assert told.startswith("error: ")
    assert message in told
    assert helped == f"help: see '{hint}'"


@pytest.mark.parametrize("words", [["--help"], ["plan", "--help"], ["launch", "--help"], ["lanch"]])
def test_what_is_only_told_imports_nothing_heavy(words: list[str]) -> None:
    done = subprocess.run(
        [sys.executable, "-c", _MODULES.format(words=words)],
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    modules = set(json.loads(done.stderr.splitlines()[-1]))
    assert not modules & _HEAVY
    assert len([name for name in modules if name.startswith("orchestra")]) < 60


@pytest.mark.parametrize(
    "words",
    [["la"], ["launch", ""], ["plan", "--"], ["launch", "a.launch.py", ""], ["launch", "a.launch.yaml", "w"]],
)
def test_completing_imports_nothing_heavy(words: list[str], folder: Path) -> None:
    (folder / "a.launch.py").write_text("DeclareLaunchArgument('world')\n")
    (folder / "a.launch.yaml").write_text("launch: [{arg: {name: world}}]\n")
    done = subprocess.run(
        [sys.executable, "-c", _MODULES.format(words=["completion", "--complete", "fish", *words])],
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    assert done.stdout
    modules = set(json.loads(done.stderr.splitlines()[-1]))
    parser = {"yaml"} if "a.launch.yaml" in words else set()
    assert modules & _HEAVY == parser
    assert not {name for name in modules if name.startswith(("orchestra.description", "orchestra.plan"))}


def test_the_keeper_of_a_run_imports_nothing_heavy() -> None:
    """Before the first fork there is our own supervise room, and little of the standard library."""
    count = (
        "import sys; before = set(sys.modules); import orchestra.__main__, orchestra.supervise.run;"
        "print(*sorted(set(sys.modules) - before))"
    )
    done = subprocess.run([sys.executable, "-S", "-E", "-c", f"import sys; sys.path = {sys.path!r}; {count}"],
                          capture_output=True, text=True, check=True, timeout=60)  # fmt: skip
    modules = done.stdout.split()
    assert not set(modules) & {
        *_HEAVY,
        "argparse",
        "asyncio",
        "dataclasses",
        "json",
        "pathlib",
        "subprocess",
        "typing",
    }


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("", False),
        ("--help", False),
        ("plan x.yaml", False),
        ("launch x.yaml", True),
        ("launch x.yaml a:=b --strict", True),
        ("launch x.yaml --help", False),
        ("launch -s x.yaml", False),
        ("launch -ns x.yaml", False),
        ("launch x.yaml --show-arguments", False),
        ("launch -d x.yaml", True),
        ("launch x.yaml --params-file shp.yaml", True),
        ("run demo talker --help", True),  # the node's own
        ("run --help", False),
        ("run --prefix gdb --help", False),
        ("run --prefix gdb demo talker -h", True),
        ("run demo talker --ros-args -p a:=1", True),
    ],
)
def test_which_command_lines_ask_for_a_run(words: str, expected: bool) -> None:
    assert starts_processes(words.split()) is expected


def test_output_that_nobody_reads_any_more_is_no_error(folder: Path) -> None:
    """`orchestra schema | head -1`: the reader goes while there is more to come than the pipe holds."""
    with subprocess.Popen(
        [sys.executable, "-m", "orchestra", "schema", "plan"],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as writer:
        assert writer.stdout
        assert writer.stderr
        writer.stdout.close()
        assert writer.stderr.read() == b""
        assert writer.wait(60) == 141
