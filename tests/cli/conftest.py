"""The command as users run it: a process of its own in a folder of its own."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from subprocess import CompletedProcess
from typing import TYPE_CHECKING, TypeAlias

import pytest

from orchestra.cli.main import main

if TYPE_CHECKING:
    from pathlib import Path

Command: TypeAlias = Callable[..., CompletedProcess[str]]


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """The folder for runs and reports."""
    return tmp_path / "home"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """The working directory of the commands."""
    path = tmp_path / "work"
    path.mkdir()
    return path


@pytest.fixture
def prefix(tmp_path: Path) -> Path:
    """An ament prefix with a package `demo`: `echo` prints its arguments, `talker` does nothing."""
    prefix = tmp_path / "prefix"
    index = prefix / "share" / "ament_index" / "resource_index" / "packages"
    programs = prefix / "lib" / "demo"
    for made in (index, programs, prefix / "share" / "demo" / "launch"):
        made.mkdir(parents=True)
    (index / "demo").write_text("")
    for name, text in {"echo": 'for word in "$@"; do echo "<$word>"; done', "talker": "exit 0"}.items():
        (programs / name).write_text(f"#!/bin/sh\n{text}\n")
        (programs / name).chmod(0o755)
    return prefix


@pytest.fixture
def orchestra_here(
    folder: Path, home: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Command:
    """Run `orchestra WORDS` in this process, which is quicker: for commands that start nothing."""

    def run(*words: str, **environment: str) -> CompletedProcess[str]:
        with monkeypatch.context() as changed:
            changed.chdir(folder)
            for name, value in {"ORCHESTRA_HOME": str(home), "NO_COLOR": "1", **environment}.items():
                changed.setenv(name, value)
            status = main(words)
        told = capsys.readouterr()
        return CompletedProcess(words, status, told.out, told.err)

    return run


@pytest.fixture
def orchestra_quickly(orchestra_beside: Command, orchestra_here: Command) -> Command:
    """Run `orchestra WORDS` in this process where it starts nothing, else beside it."""

    def run(*words: str, **environment: str) -> CompletedProcess[str]:
        chosen = orchestra_beside if words[:1] in (("launch",), ("run",)) else orchestra_here
        return chosen(*words, **environment)

    return run


@pytest.fixture
def orchestra(orchestra_beside: Command) -> Command:
    """Run `orchestra WORDS` and return what came of it."""
    return orchestra_beside


@pytest.fixture
def orchestra_beside(folder: Path, home: Path) -> Command:
    """Run `orchestra WORDS` in a process of its own."""

    def run(*words: str, **environment: str) -> CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, "-m", "orchestra", *words],
            cwd=folder,
            env={**os.environ, "ORCHESTRA_HOME": str(home), "NO_COLOR": "1", **environment},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=90,
            check=False,
        )

    return run
