"""`orchestra format` as users run it."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from subprocess import CompletedProcess

import pytest

Command = Callable[..., CompletedProcess[str]]


@pytest.fixture
def orchestra(orchestra_quickly: Command) -> Command:
    """Run the command; what starts nothing, in this process."""
    return orchestra_quickly


_ROOT = Path(__file__).parents[2]
_UGLY = "launch:\n- log:   {message: a}  # x\n"
_NICE = "launch:\n  - log: {message: a}  # x\n"


@pytest.fixture
def files(folder: Path) -> Path:
    """Two files that are not as they should be, one that is, and some that are none of the command's business."""
    (folder / "launch").mkdir()
    (folder / "launch" / "a.launch.yaml").write_text(_UGLY)
    (folder / "launch" / "b.launch.xml").write_text("<launch><log message='a'/></launch>")
    (folder / "params.yaml").write_text("/**:\n  ros__parameters: {a: 1}\n")
    (folder / "other.yaml").write_text("a:   1\n")
    (folder / "c.launch.py").write_text("def generate_launch_description( ): pass\n")
    return folder


def test_files_that_differ_are_written_and_counted(orchestra: Command, files: Path) -> None:
    found = orchestra("format", ".")
    assert (found.returncode, found.stdout, found.stderr) == (
        0,
        "",
        "2 files formatted, 1 file left unchanged\n",
    )
    assert (files / "launch" / "a.launch.yaml").read_text() == _NICE
    assert (files / "launch" / "b.launch.xml").read_text() == '<launch>\n  <log message="a"/>\n</launch>\n'
    assert (files / "other.yaml").read_text() == "a:   1\n"
    before = (files / "params.yaml").stat().st_mtime_ns
    found = orchestra("format", ".")
    assert (found.returncode, found.stderr) == (0, "3 files left unchanged\n")
    assert (files / "params.yaml").stat().st_mtime_ns == before


def test_check_names_what_would_be_changed(orchestra: Command, files: Path) -> None:
    found = orchestra("format", "--check", ".")
    assert (found.returncode, found.stdout) == (1, "launch/a.launch.yaml\nlaunch/b.launch.xml\n")
    assert found.stderr == "2 files would be formatted, 1 file left unchanged\n"
    assert (files / "launch" / "a.launch.yaml").read_text() == _UGLY
    assert orchestra("format", "--check", "params.yaml").returncode == 0


def test_diff_can_be_applied(orchestra: Command, files: Path) -> None:
    found = orchestra("format", "--diff", ".")
    assert found.returncode == 1
    assert (files / "launch" / "a.launch.yaml").read_text() == _UGLY
    subprocess.run(["patch", "-p0", "-s"], input=found.stdout, text=True, cwd=files, check=True, timeout=30)
    assert orchestra("format", "--check", ".").returncode == 0


@pytest.mark.parametrize("words", [("-",), ("--stdin", "launch/a.launch.yaml"), ("-", "--stdin", "x.yaml")])
def test_standard_input_goes_to_standard_output(folder: Path, words: tuple[str, ...]) -> None:
    found = _piped(folder, _UGLY.encode(), *words)
    assert (found.returncode, found.stdout, found.stderr) == (0, _NICE.encode(), b"")


def test_a_syntax_error_on_standard_input_prints_nothing_else(folder: Path) -> None:
    found = _piped(folder, b"launch:\n  - log: {\n", "--stdin", "a.launch.yaml")
    assert (found.returncode, found.stdout) == (2, b"")
    assert b"a.launch.yaml:" in found.stderr
    assert b"[ORC002]" in found.stderr or b"[ORC0" in found.stderr


def _piped(folder: Path, text: bytes, *words: str) -> CompletedProcess[bytes]:
    return subprocess.run(
        [sys.executable, "-m", "orchestra", "format", *words],
        input=text,
        cwd=folder,
        env={**os.environ, "NO_COLOR": "1"},
        capture_output=True,
        timeout=60,
        check=False,
    )


def test_a_file_with_a_syntax_error_is_never_touched(orchestra: Command, files: Path) -> None:
    broken = "launch:\n- log: {message: a\n"
    (files / "broken.launch.yaml").write_text(broken)
    found = orchestra("format", ".")
    assert found.returncode == 2
    assert "broken.launch.yaml:" in found.stderr
    assert "2 files formatted, 1 file left unchanged" in found.stderr
    assert (files / "broken.launch.yaml").read_text() == broken


def test_what_has_no_form_is_told_and_left(orchestra: Command, folder: Path) -> None:
    (folder / "a.launch.yaml").write_text("launch:\n- ? log\n  : {message: a}\n")
    found = orchestra("format", "a.launch.yaml")
    assert found.returncode == 0
    assert found.stderr.startswith("a.launch.yaml is left as it is: it has a key behind a question mark\n")


def test_the_length_of_lines_can_be_chosen(orchestra: Command, folder: Path) -> None:
    (folder / "a.launch.yaml").write_text(_NICE)
    assert orchestra("format", "--check", "--line-length", "20", "a.launch.yaml").returncode == 1
    assert orchestra("format", "--line-length", "none", "a.launch.yaml").returncode == 2


@pytest.mark.parametrize("words", [(), ("missing.yaml",), ("-", "a.yaml")])
def test_a_command_line_that_makes_no_sense_is_refused(orchestra: Command, words: tuple[str, ...]) -> None:
    assert orchestra("format", *words).returncode == 2


def test_the_bringup_is_formatted(orchestra: Command) -> None:
    found = orchestra("format", "--check", str(_ROOT / "bringup"))
    assert (found.returncode, found.stdout) == (0, "")


def test_a_launch_file_in_python_is_left_to_others(orchestra: Command, folder: Path) -> None:
    (folder / "a.launch.py").write_text("x = [1,2]\n")
    found = orchestra("format", "a.launch.py")
    assert (found.returncode, found.stdout) == (0, "")
    assert found.stderr == "1 file in Python left alone: YAML, XML and parameter files are formatted\n"
