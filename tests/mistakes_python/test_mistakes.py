"""Mistakes in Python launch files: each is told, once, where it stands, with what was meant."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from orchestra.errors import Problems
from orchestra.pipeline import collect, inputs_from
from tests.mistakes_python.reading import FOLDER, Case, Told, cases

_DEFAULTED = """\
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.substitutions import LaunchConfiguration

def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('use_sim_time', default_value='false'),
        DeclareLaunchArgument('rate', default_value='5'),
        LogInfo(msg=[LaunchConfiguration('use_sim_time'), LaunchConfiguration('rate')]),
    ])
"""
_INNER = """\
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.substitutions import LaunchConfiguration

def generate_launch_description():
    return LaunchDescription([DeclareLaunchArgument('needed'), LogInfo(msg=LaunchConfiguration('needed'))])
"""
_PARAMETERS = "/**:\n  ros__parameters:\n    rate: 5\n"

_CASES = [pytest.param(case, id=case.name) for path in sorted(FOLDER.iterdir()) for case in cases(path)]
_PATHS = [case for case in _CASES if re.search(r"\b(path|file)\b(?!.*no blanks)", str(case.id))]


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the prefix of a package `demo`; the working directory has files to include and to read."""
    return _installed(tmp_path, monkeypatch)


def _installed(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    prefix = folder / "install"
    for made in (
        "share/ament_index/resource_index/packages",
        "lib/demo",
        "share/demo/launch",
        "share/demo/config",
    ):
        (prefix / made).mkdir(parents=True)
    (prefix / "share/ament_index/resource_index/packages/demo").touch()
    for program in ("talker", "component_container"):
        (prefix / f"lib/demo/{program}").write_text("#!/bin/sh\n", "utf-8")
        (prefix / f"lib/demo/{program}").chmod(0o755)
    work = folder / "work"
    work.mkdir()
    for place in (work, prefix / "share/demo/launch"):
        (place / "inner.launch.py").write_text(_INNER, "utf-8")
        (place / "defaulted.launch.py").write_text(_DEFAULTED, "utf-8")
    for place in (work, prefix / "share/demo/config"):
        (place / "params.yaml").write_text(_PARAMETERS, "utf-8")
    monkeypatch.chdir(work)
    return prefix


# The compiler's doubts are warnings, as where launch files are launched, and no errors.
@pytest.mark.filterwarnings("ignore::SyntaxWarning")
@pytest.mark.parametrize("case", _CASES)
def test_a_mistake_is_told(workspace: Path, case: Case) -> None:
    if case.name.endswith("no blanks") and " " in str(workspace):
        pytest.skip("the words of its command are others where folders have blanks in their names")
    _check(case, workspace)


@pytest.mark.parametrize("case", _PATHS)
def test_a_mistake_in_a_path_is_told_where_folders_have_blanks_in_their_names(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, case: Case
) -> None:
    (tmp_path / "my own robot").mkdir()
    _check(case, _installed(tmp_path / "my own robot", monkeypatch))


def _check(case: Case, workspace: Path) -> None:
    for name, text in case.files.items():
        Path(name).write_text(text, "utf-8")
    problems = Problems()
    environment = {"PATH": "/usr/bin:/bin", "AMENT_PREFIX_PATH": str(workspace)}
    collect(case.entry, inputs_from(case.words, environment=environment), problems)
    found = [
        Told(
            problem.span.file,
            (problem.span.line, problem.span.column),
            (problem.span.end_line, problem.span.end_column),
            problem.suggestion,
        )
        for problem in problems
        if problem.span is not None and problem.span.file in case.files
    ]
    elsewhere = [
        problem.suggestion
        for problem in problems
        if problem.span is None or problem.span.file not in case.files
    ]
    shown = "\n".join(
        f"{problem.span}: {problem.code} {problem.message} {problem.notes}" for problem in problems
    )
    assert sorted(found, key=str) == sorted(case.told, key=str), shown
    assert elsewhere == case.suggestions, shown
    assert "orchestra" not in shown
    assert " at 0x" not in shown
