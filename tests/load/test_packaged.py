"""A package beside the file of an include: the file is taken for one of that package, which is told once."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.description.actions.include import Include
from orchestra.errors import Problems
from orchestra.load.files import load

if TYPE_CHECKING:
    from pathlib import Path

_MEANT = "$(find-pkg-share demo)/launch/a.launch.xml"
_CASES = {
    "a.launch.yaml": (
        "launch:\n- include: {pkg: demo, file: launch/a.launch.xml}\n",
        f"file: {_MEANT}",
        "pkg: demo, file: launch/a.launch.xml",
    ),
    "a.launch.xml": (
        '<launch>\n<include pkg="demo" file="launch/a.launch.xml"/></launch>',
        f'file="{_MEANT}"',
        'pkg="demo" file="launch/a.launch.xml"',
    ),
}


@pytest.mark.parametrize("name", _CASES)
def test_a_package_beside_a_file_is_told_once_with_what_is_meant(name: str, tmp_path: Path) -> None:
    text, suggestion, marked = _CASES[name]
    path, problems = tmp_path / name, Problems()
    path.write_text(text, "utf-8")
    description = load(str(path), problems)
    (problem,) = problems
    assert problem.suggestion == suggestion
    assert problem.span is not None
    line = text.split("\n")[1]
    assert line[problem.span.column - 1 : problem.span.end_column - 1] == marked
    assert description is not None
    (include,) = description.actions
    assert isinstance(include, Include)
    assert include.file.raw == _MEANT
