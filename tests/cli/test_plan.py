"""`orchestra plan`: the plan on standard output, what is wrong on standard error."""

from __future__ import annotations

import json
from collections.abc import Callable
from subprocess import CompletedProcess
from typing import TYPE_CHECKING

import pytest

from orchestra.plan import codec
from orchestra.plan.render.formats import FORMATS

if TYPE_CHECKING:
    from pathlib import Path

Command = Callable[..., CompletedProcess[str]]


@pytest.fixture
def orchestra(orchestra_quickly: Command) -> Command:
    """Run the command; what starts nothing, in this process."""
    return orchestra_quickly


_GOOD = """\
launch:
  - arg: {name: who, default: world, choices: [world, moon], description: whom to greet}
  - executable: {cmd: "echo hello $(var who)", name: greet}
"""
_LEAKING = """\
launch:
  - include: {file: good.yaml, arg: [{name: nobody, value: x}]}
"""
_BAD = """\
launch:
  - executable: {cmd: echo hello, nmae: greet}
"""


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    for name, text in {"good": _GOOD, "leaking": _LEAKING, "bad": _BAD}.items():
        (folder / f"{name}.yaml").write_text(text)


def test_text_is_the_rendered_plan(orchestra_beside: Command) -> None:
    found = orchestra_beside("plan", "good.yaml", "who:=moon")
    assert (found.returncode, found.stderr) == (0, "")
    assert found.stdout.startswith("good.yaml: 1 process\n")
    assert "who := moon  (default world)" in found.stdout
    assert "echo hello moon" in found.stdout


def test_text_takes_no_module_of_other_formats(orchestra_beside: Command) -> None:
    found = orchestra_beside("plan", "--no-cache", "good.yaml", PYTHONPROFILEIMPORTTIME="1")
    imported = {line.rpartition("|")[2].strip() for line in found.stderr.splitlines()}
    assert "orchestra.plan.render.details" in imported
    others = ("shell.words", "drawing", "triggers", "conduct")
    assert imported.isdisjoint(f"orchestra.plan.render.{name}" for name in others)
    assert imported.isdisjoint({"orchestra.cli.planning.host", "orchestra.cli.planning.choice"})


def test_json_is_the_plan_and_the_same_each_time(orchestra: Command) -> None:
    first, second = (orchestra("plan", "good.yaml", "--format", "json") for _ in range(2))
    assert (first.returncode, first.stderr) == (0, "")
    assert first.stdout == second.stdout
    plan = codec.loads(first.stdout)
    assert [process.command for process in plan.processes] == [("echo", "hello", "world")]
    assert FORMATS["text"](plan) == orchestra("plan", "good.yaml").stdout


@pytest.mark.parametrize(
    "words", [("--format", "json", "good.yaml", "who:=moon"), ("good.yaml", "who:=moon", "--format=json")]
)
def test_options_stand_anywhere(orchestra: Command, words: tuple[str, ...]) -> None:
    assert json.loads(orchestra("plan", *words).stdout)["arguments"][0]["value"] == "moon"


def test_warnings_in_text_are_told_beside_the_plan(orchestra: Command) -> None:
    found = orchestra("plan", "leaking.yaml")
    assert found.returncode == 0
    assert "leaking.yaml:2:" in found.stderr
    assert "1 warning" in found.stderr
    assert found.stdout.startswith("leaking.yaml: 1 process\n")


def test_warnings_in_json_are_told_inside(orchestra: Command) -> None:
    found = orchestra("plan", "leaking.yaml", "--format", "json")
    assert (found.returncode, found.stderr) == (0, "")
    assert [problem["severity"] for problem in json.loads(found.stdout)["problems"]] == ["warning"]


def test_strict_takes_warnings_for_errors(orchestra: Command) -> None:
    found = orchestra("plan", "leaking.yaml", "--strict")
    assert (found.returncode, found.stdout) == (2, "")
    assert "1 error" in found.stderr


def test_an_error_leaves_standard_output_empty(orchestra: Command) -> None:
    found = orchestra("plan", "bad.yaml")
    assert (found.returncode, found.stdout) == (2, "")
    assert "bad.yaml:2:35: error: " in found.stderr
    assert "  - executable: {cmd: echo hello, nmae: greet}" in found.stderr
    assert "help: did you mean 'name'?" in found.stderr


def test_errors_can_be_had_as_json(orchestra: Command) -> None:
    found = orchestra("plan", "bad.yaml", "--format", "json")
    assert (found.returncode, found.stdout) == (2, "")
    (problem,) = json.loads(found.stderr)
    assert (problem["code"], problem["line"], problem["suggestion"]) == ("ORC004", 2, "name")


def test_a_mistake_of_the_command_line_is_shown_in_it(orchestra: Command) -> None:
    found = orchestra("plan", "good.yaml", "who:=moon", "woh:=mars")
    assert found.returncode == 2
    assert "command line:1:11: error: " in found.stderr
    assert "    1 | who:=moon woh:=mars\n      |           ^^^\n" in found.stderr
    assert "did you mean 'who'?" in found.stderr


def test_a_launch_file_of_a_package_is_found_by_its_name(orchestra: Command, prefix: Path) -> None:
    (prefix / "share" / "demo" / "launch" / "greet.launch.yaml").write_text(_GOOD)
    found = orchestra("plan", "demo", "greet.launch.yaml", "who:=moon", AMENT_PREFIX_PATH=str(prefix))
    assert (found.returncode, found.stderr) == (0, "")
    assert "echo hello moon" in found.stdout


def test_parameters_of_the_command_line_win(orchestra: Command, folder: Path, prefix: Path) -> None:
    node = "{pkg: demo, exec: talker, name: talker, param: [{name: rate, value: 1}, {name: size, value: 1}]}"
    (folder / "talk.yaml").write_text(f"launch:\n  - node: {node}\n")
    (folder / "fast.yaml").write_text("/**:\n  ros__parameters: {rate: 2, size: 2, loud: true}\n")
    found = orchestra(
        *("plan", "talk.yaml", "--params-file", "fast.yaml", "talker:size:=3", "--format", "json"),
        AMENT_PREFIX_PATH=str(prefix),
    )
    (process,) = json.loads(found.stdout)["processes"]
    assert process["parameters"] == {"rate": 2, "size": 3, "loud": True}


def test_a_parameter_file_that_is_not_there_is_a_mistake(orchestra: Command) -> None:
    found = orchestra("plan", "good.yaml", "--params-file", "fats.yaml")
    assert (found.returncode, found.stdout) == (2, "")
    assert "fats.yaml" in found.stderr
