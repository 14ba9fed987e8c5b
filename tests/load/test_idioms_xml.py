"""Idioms of public launch files in XML and YAML: what they come to, and that nothing is held against them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from orchestra.errors import Problems, Severity
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.codec import encode
from tests.load.planning import installed

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path


def resolved(
    folder: Path, files: Mapping[str, str], *words: str, warnings: int = 0
) -> tuple[dict[str, Any], str]:
    """Return the plan of the first of these files, which are in the share folder of `demo`, and that folder."""
    environment = installed(folder)
    share = folder / "prefix/share/demo"
    for name, text in files.items():
        path = share / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, "utf-8")
    problems = Problems()
    plan = collect(str(share / next(iter(files))), inputs_from(words, environment=environment), problems)
    found = [(str(problem.span), problem.message) for problem in problems]
    assert all(problem.severity is Severity.WARNING for problem in problems), found
    assert len(found) == warnings, found
    assert plan is not None
    return encode(plan), str(share)


def messages(content: Mapping[str, Any]) -> list[str]:
    """Return what is logged, in order."""
    return [step["message"] for trigger in content["triggers"] for step in trigger["do"]]


SHOWN = '<launch><arg name="file"/><arg name="level" default="0"/><log message="$(var file) $(var level)"/></launch>'


@pytest.mark.parametrize(
    ("arguments", "shown"),
    [
        (
            '<arg name="folder" value="$(dirname)/config"/><arg name="file" value="$(var folder)/common.yaml"/>',
            "{share}/config/common.yaml 0",
        ),
        (
            "<arg name=\"level\" value=\"$(eval '1 + int(\\'$(var id)\\') ')\"/>"
            "<arg name=\"file\" value=\"$(eval ' \\'robot_\\' + \\'$(var level)\\' ')\"/>",
            "robot_3 3",
        ),
        ('<arg name="id" value="$(var id)0"/><arg name="file" value="$(var id)"/>', "20 0"),
    ],
    ids=["folder-and-files", "number-and-name", "itself"],
)
def test_an_argument_of_an_include_reads_those_before_it(arguments: str, shown: str, tmp_path: Path) -> None:
    include = f'<include file="$(dirname)/shown.launch.xml">{arguments}</include>'
    main = f'<launch><arg name="id" default="2"/>{include}</launch>'
    content, share = resolved(tmp_path, {"main.launch.xml": main, "shown.launch.xml": SHOWN})
    assert messages(content) == [shown.format(share=share)]


@pytest.mark.parametrize(
    ("written", "words"),
    [
        ('args=""', [""]),
        ('args=" "', [""]),
        ('args="$(var none)"', [""]),
        ('args="-x $(var none)"', ["-x", ""]),
        ('ros_args=""', ["--ros-args", ""]),
        ("", []),
    ],
)
def test_arguments_that_are_written_empty_are_one_empty_word(
    written: str, words: list[str], tmp_path: Path
) -> None:
    node = f'<node pkg="demo" exec="tool" {written}/>'
    container = f'<node_container pkg="demo" exec="tool" name="c" namespace="" {written}/>'
    main = f'<launch><arg name="none" default=""/>{node}{container}</launch>'
    content, _ = resolved(tmp_path, {"main.launch.xml": main})
    first, second = (process["command"][1:] for process in content["processes"])
    assert first == [*words, "--ros-args"]
    assert second[: len(words) + 1] == first
