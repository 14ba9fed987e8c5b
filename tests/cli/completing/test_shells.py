"""The Tab key in real shells: what the line says afterwards is what the user meant."""

from __future__ import annotations

import os
import shutil
import subprocess
from typing import TYPE_CHECKING

import pytest

from tests.cli.completing.typing_shells import bash, zsh

if TYPE_CHECKING:
    from pathlib import Path

# what is typed before the Tab key, the words of the line after it
_LINES = [
    ("orchestra lau", "orchestra launch"),
    ("orchestra launch sma", "orchestra launch small.launch.yaml"),
    ("orchestra launch ./sma", "orchestra launch ./small.launch.yaml"),
    ("orchestra launch my", "orchestra launch 'my worlds/'"),
    (r"orchestra launch my\ worlds/", "orchestra launch 'my worlds/big.launch.yaml'"),
    ('orchestra launch "my worlds/b', "orchestra launch 'my worlds/big.launch.yaml'"),
    ("orchestra launch dem", "orchestra launch demo"),
    ("orchestra launch demo ta", "orchestra launch demo talk.launch.yaml"),
    ("orchestra plan demo/", "orchestra plan demo/talk"),
    ("orchestra check sma", "orchestra check small.launch.yaml"),
    ("orchestra launch small.launch.yaml wor", "orchestra launch small.launch.yaml world:="),
    ("orchestra launch small.launch.yaml world:=m", "orchestra launch small.launch.yaml world:=maze"),
    ("orchestra launch small.launch.yaml world:=t", "orchestra launch small.launch.yaml 'world:=two words'"),
    ("orchestra launch small.launch.yaml world:=i", """orchestra launch small.launch.yaml "world:=it's" """),
    ('orchestra launch small.launch.yaml "world:=t', "orchestra launch small.launch.yaml 'world:=two words'"),
    ("orchestra launch small.launch.yaml 'world:=t", "orchestra launch small.launch.yaml 'world:=two words'"),
    ('orchestra launch small.launch.yaml world:="t', "orchestra launch small.launch.yaml 'world:=two words'"),
    ("orchestra launch demo/talk world:=m", "orchestra launch demo/talk world:=maze"),
    ("orchestra launch small.launch.yaml headless:=f", "orchestra launch small.launch.yaml headless:=false"),
    ("orchestra plan --form", "orchestra plan --format"),
    ("orchestra plan --format j", "orchestra plan --format json"),
    ("orchestra plan --format=j", "orchestra plan --format=json"),
    ("orchestra run dem", "orchestra run demo"),
    ("orchestra run demo tal", "orchestra run demo talker"),
    ("orchestra schema ev", "orchestra schema event"),
    ("orchestra completion f", "orchestra completion fish"),
    ("orchestra nothing sma", "orchestra nothing sma"),
    ("orchestra launch nowhere.launch.yaml wor", "orchestra launch nowhere.launch.yaml wor"),
]


def _words(line: str) -> list[str]:
    shell = subprocess.run(
        ["bash", "-c", rf"printf '%s\n' {line}"], capture_output=True, text=True, check=True
    )
    return shell.stdout.splitlines()


def _needs(shell: str, surroundings: dict[str, str]) -> None:
    """Skip where a shell is not installed; in CI it has to be."""
    if shutil.which(shell, path=surroundings["PATH"]) is None:
        assert "CI" not in os.environ, f"{shell} is missing in .ci/packages.txt"
        pytest.skip(f"{shell} is not installed")


@pytest.mark.parametrize("start", [bash, zsh], ids=["bash", "zsh"])
def test_a_line_is_completed(start: object, folder: Path, surroundings: dict[str, str]) -> None:
    assert callable(start)
    name = getattr(start, "__name__", "")
    _needs(name, surroundings)
    with start(folder, surroundings) as shell:
        found = {typed: shell.words_after_tab(typed) for typed, _ in _LINES}
    assert found == {typed: _words(line) for typed, line in _LINES}


def test_bash_shows_what_a_line_may_become(folder: Path, surroundings: dict[str, str]) -> None:
    with bash(folder, surroundings) as shell:
        assert shell.words_after_tab("orchestra launch demo/talk world:=") == _words(
            "orchestra launch demo/talk world:="
        )
        assert {"maze", r"two\ words", r"it\'s"} <= set(shell.shown.replace("\r\n", "  ").split("  "))


def test_bash_completes_the_command_by_its_path(folder: Path, surroundings: dict[str, str]) -> None:
    program = shutil.which("orchestra", path=surroundings["PATH"])
    assert program is not None
    (folder / "programs").symlink_to(program.rpartition("/")[0])
    with bash(folder, surroundings) as shell:
        assert shell.words_after_tab("programs/orchestra lau") == ["programs/orchestra", "launch"]


@pytest.mark.parametrize(
    ("typed", "expected"),
    [
        ("orchestra lau", ["launch\tstart what a launch file describes, watch it, stop it"]),
        ("orchestra launch small.launch.yaml wor", ["world:=\twhere to be (default: maze)"]),
        (
            "orchestra launch small.launch.yaml world:=",
            ["world:=maze", "world:=two words", "world:=it's"],
        ),
        ("orchestra plan --form", ["--format\thow to show it (default: text)"]),
        (r"orchestra launch my\ worlds/", ["my worlds/big.launch.yaml"]),
        ("orchestra nothing ", []),
    ],
)
def test_fish_shows_what_a_line_may_become(
    typed: str, expected: list[str], folder: Path, surroundings: dict[str, str]
) -> None:
    _needs("fish", surroundings)
    asked = f"orchestra completion fish | source; complete --do-complete {typed!r}"
    shell = subprocess.run(
        ["fish", "--no-config", "-c", asked],
        cwd=folder,
        # Elsewhere it finds no program in a folder with an umlaut.
        env={**surroundings, "LC_ALL": "C.UTF-8"},
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    assert [line.rstrip("\t") for line in shell.stdout.splitlines()] == expected
