"""`orchestra convert` as it is called."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

_YAML = "launch:\n- log: {message: hello}\n"
_PYTHON = """\
from launch import LaunchDescription
from launch.actions import LogInfo, OpaqueFunction


def generate_launch_description():
    print("said by code")
    return LaunchDescription([LogInfo(msg="hello"), OpaqueFunction(function=print)])
"""


def _convert(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "orchestra", "convert", *words]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "a.launch.yaml").write_text(_YAML, "utf-8")
    (tmp_path / "b.launch.py").write_text(_PYTHON, "utf-8")
    return tmp_path


def test_the_result_goes_to_standard_output(folder: Path) -> None:
    done = _convert(folder, "a.launch.yaml", "--to", "xml")
    assert done.stdout == '<?xml version="1.0"?>\n<launch>\n  <log message="hello"/>\n</launch>\n'
    assert (done.returncode, done.stderr) == (0, "")


def test_a_file_is_written_over_only_where_that_is_said(folder: Path) -> None:
    words = ("a.launch.yaml", "--to", "python", "--output", "b.launch.py")
    refused = _convert(folder, *words)
    assert refused.returncode == 2
    assert "b.launch.py is there already: --force writes over it" in refused.stderr
    assert (folder / "b.launch.py").read_text("utf-8") == _PYTHON
    assert _convert(folder, *words, "--force").returncode == 0
    assert 'LogInfo(msg="hello")' in (folder / "b.launch.py").read_text("utf-8")


def test_what_cannot_be_converted_is_told_and_nothing_is_written(folder: Path) -> None:
    told = "b.launch.py:7:53: error: cannot be converted: only Python code knows what this OpaqueFunction of print() does"
    done = _convert(folder, "b.launch.py", "--to", "yaml", "--output", "c.launch.yaml")
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.splitlines() == ["said by code", told]
    assert not (folder / "c.launch.yaml").exists()


def test_a_part_is_written_where_that_is_said(folder: Path) -> None:
    done = _convert(folder, "b.launch.py", "--to", "yaml", "--partial")
    assert done.returncode == 1
    assert done.stdout.splitlines() == [
        "launch:",
        "  - log:",
        "      message: hello",
        "  # not converted: only Python code knows what this OpaqueFunction of print() does",
    ]


def test_mistakes_of_the_file_are_told_as_everywhere(folder: Path) -> None:
    (folder / "a.launch.yaml").write_text("launch:\n- lug: {}\n", "utf-8")
    done = _convert(folder, "a.launch.yaml", "--to", "xml")
    assert done.returncode == 2
    assert done.stderr.startswith("a.launch.yaml:2:3: error: unknown action 'lug'")


def test_the_language_of_the_file_itself_is_refused(folder: Path) -> None:
    done = _convert(folder, "a.launch.yaml", "--to", "yaml")
    assert done.returncode == 2
    assert "a.launch.yaml is in yaml already: `orchestra format` brings it into one form" in done.stderr


@pytest.mark.parametrize("words", [("nowhere.launch.py",), ("nowhere.launch.yaml",), ("nowhere.launch",)])
def test_a_file_that_is_not_there_is_told(words: tuple[str, ...], folder: Path) -> None:
    done = _convert(folder, *words, "--to", "xml" if "launch.py" in words[0] else "python")
    assert done.returncode == 2
    assert f"there is no launch file {words[0]}" in done.stderr


def test_what_is_no_file_is_not_read(folder: Path) -> None:
    """It may have no end, or none that comes."""
    os.mkfifo(folder / "fifo.launch.yaml")
    for path in ("fifo.launch.yaml", "/dev/zero", "."):
        done = _convert(folder, path, "--to", "xml")
        assert (done.returncode, "is there, but it is no file" in done.stderr) == (2, True)
