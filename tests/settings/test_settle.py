"""How much problems weigh in the end: settings, comments, what nothing lowers; the same for plan and check."""

from __future__ import annotations

import os
from dataclasses import replace
from typing import TYPE_CHECKING

import pytest

from orchestra.cli.checking import Manner, check
from orchestra.cli.targets import targets
from orchestra.errors import Code, DescriptionError, Problem, Problems, Severity
from orchestra.pipeline import inputs_from, make_plan
from orchestra.settings.comments import ignores
from orchestra.settings.model import LASTING
from orchestra.settings.settle import unused

if TYPE_CHECKING:
    from pathlib import Path

_MISSPELT = "launch:\n  - executable: {cmd: ls, nmae: x}%s\n"


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _checked(folder: Path, *, strict: bool = False, **severity: str) -> list[tuple[str, str, int]]:
    inputs = replace(inputs_from([], environment=os.environ), severity=severity)
    found = check(targets([str(folder)]), inputs, Manner(strict=strict)).problems
    return [(item.code, item.severity, item.span.line) for item in found if item.span is not None]


def _write(folder: Path, comment: str = "", name: str = "a.launch.yaml") -> None:
    (folder / name).parent.mkdir(exist_ok=True)
    (folder / name).write_text(_MISSPELT % comment)


@pytest.mark.parametrize(
    ("settings", "found"),
    [
        ("", [("ORC004", "error", 2)]),
        ("[severity]\nORC004 = 'warning'\n", [("ORC004", "warning", 2)]),
        ("[severity]\nORC004 = 'note'\n", [("ORC004", "note", 2)]),
        ("[severity]\nORC004 = 'off'\n", []),
        ("[severity]\nORC005 = 'off'\n", [("ORC004", "error", 2)]),
        ("[[overrides]]\nfiles = ['*.yaml']\nseverity = {ORC004 = 'off'}\n", []),
        ("[[overrides]]\nfiles = ['b*']\nseverity = {ORC004 = 'off'}\n", [("ORC004", "error", 2)]),
        ("exclude = ['a.*']\n", []),
    ],
)
def test_settings(folder: Path, settings: str, found: list[tuple[str, str, int]]) -> None:
    _write(folder)
    (folder / "b.launch.yaml").write_text("launch: [log: {message: x}]\n")
    (folder / "orchestra.toml").write_text(settings)
    assert _checked(folder) == found


def test_the_command_line_wins_over_settings(folder: Path) -> None:
    _write(folder)
    (folder / "orchestra.toml").write_text("[severity]\nORC004 = 'off'\n")
    assert _checked(folder, ORC004="warning") == [("ORC004", "warning", 2)]


def test_a_plan_is_made_of_what_has_been_lowered(folder: Path) -> None:
    _write(folder)
    inputs = inputs_from([], environment=os.environ)
    with pytest.raises(DescriptionError):
        make_plan(str(folder / "a.launch.yaml"), inputs)
    (folder / "pyproject.toml").write_text("[tool.orchestra.severity]\nORC004 = 'warning'\n")
    plan = make_plan(str(folder / "a.launch.yaml"), inputs)
    assert [problem.severity for problem in plan.problems] == [Severity.WARNING]
    (folder / "pyproject.toml").write_text("[tool.orchestra]\nstrict = true\nseverity = {ORC004 = 'off'}\n")
    assert make_plan(str(folder / "a.launch.yaml"), inputs).problems == ()


@pytest.mark.parametrize(
    ("settings", "found"),
    [
        ("strict = true\n", "note"),
        ("[severity]\nORC022 = 'warning'\n", "warning"),
        ("severity.ORC022 = 'off'\n", ""),
    ],
)
def test_notes_stay_what_they_are_where_warnings_are_errors(folder: Path, settings: str, found: str) -> None:
    (folder / "a.launch.yaml").write_text("launch:\n  - arg: {name: robot}\n")
    (folder / "orchestra.toml").write_text(settings)
    inputs = inputs_from([], environment=os.environ)
    assert (
        "".join(item.severity for item in check(targets([str(folder)]), inputs, Manner()).problems) == found
    )


def test_the_settings_nearest_to_the_problem_count(folder: Path) -> None:
    _write(folder, name="inner/b.launch.yaml")
    (folder / "a.launch.yaml").write_text("launch: [include: {file: inner/b.launch.yaml}]\n")
    (folder / "orchestra.toml").write_text("[severity]\nORC004 = 'off'\n")
    assert _checked(folder) == []
    (folder / "inner/orchestra.toml").write_text("strict = true\n")
    assert _checked(folder) == [("ORC004", "error", 2)]


def test_broken_settings_are_one_problem_however_many_files_they_are_for(folder: Path) -> None:
    for name in ("a.launch.yaml", "b.launch.yaml"):
        (folder / name).write_text("launch: [log: {message: x}]\n")
    (folder / "orchestra.toml").write_text("strikt = true\n")
    assert _checked(folder) == [("ORC004", "error", 1)]


@pytest.mark.parametrize(
    ("comment", "found"),
    [
        ("  # orchestra: ignore", []),
        ("  # orchestra: ignore[ORC004]", []),
        ("  # orchestra: ignore[ORC005]", [("ORC004", "error", 2)]),
        ("  # orchestra: ignore[ORC004, ORC9]", [("ORC100", "warning", 2)]),
    ],
)
def test_comments(folder: Path, comment: str, found: list[tuple[str, str, int]]) -> None:
    _write(folder, comment)
    assert _checked(folder) == found


def test_a_comment_that_silences_nothing_is_told_where_that_is_asked_for(folder: Path) -> None:
    (folder / "a.launch.yaml").write_text("launch: [log: {message: x}]  # orchestra: ignore\n")
    assert _checked(folder) == []
    assert _checked(folder, strict=True) == [("ORC100", "warning", 1)]


def test_a_comment_that_is_needed_where_the_file_is_included_is_none_too_many(folder: Path) -> None:
    (folder / "a.launch.yaml").write_text("launch: [include: {file: b.launch.yaml}]\n")
    _write(folder, "  # orchestra: ignore", "b.launch.yaml")
    assert _checked(folder, strict=True) == []


def test_parameter_files_have_comments_too(folder: Path) -> None:
    text = "/a:\n  ros__parameters:\n    x: 1\n    x: 2%s\n"
    (folder / "a.yaml").write_text(text % "")
    assert [code for code, _, _ in _checked(folder)] == ["ORC042"]
    (folder / "a.yaml").write_text(text % "  # orchestra: ignore[ORC042]")
    assert _checked(folder) == []


@pytest.mark.parametrize("how", ["comment", "settings"])
def test_what_leaves_a_gap_in_the_plan_stays_an_error_and_says_so(folder: Path, how: str) -> None:
    (folder / "a.launch.yaml").write_text(
        "launch:\n  - exce: {}" + ("  # orchestra: ignore\n" if how == "comment" else "\n")
    )
    (folder / "orchestra.toml").write_text("[severity]\nORC007 = 'off'\n" if how == "settings" else "")
    found = check(targets([str(folder)]), inputs_from([], environment=os.environ), Manner()).problems
    assert [item.severity for item in found] == [Severity.ERROR]
    assert any("cannot be" in note for note in found[0].notes)


def test_a_warning_of_any_code_can_be_silenced(folder: Path) -> None:
    (folder / "a.launch.yaml").write_text("launch:\n  - node: {pkg: qqqqqqqq, exec: x}\n")
    assert [code for code, _, _ in _checked(folder)] == ["ORC030"]
    assert Code.MISSING_PACKAGE in LASTING
    assert _checked(folder, ORC030="off") == []


def test_unknown_codes_are_told_with_what_was_meant() -> None:
    problems = Problems()
    unused(ignores("a: 1  # orchestra: ignore[orc004]\n", "a.yaml"), set(), problems, strict=True)
    (problem,) = problems
    assert isinstance(problem, Problem)
    assert (problem.suggestion, str(problem.span)) == ("ORC004", "a.yaml:1:27")
