"""What code asks of a terminal is no mistake where a check has none."""

from __future__ import annotations

import io
import json
import sys
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

    from tests.cli.conftest import Command

_FILE = """\
import os
from launch import LaunchDescription
from launch.actions import LogInfo


def generate_launch_description():
    return LaunchDescription([LogInfo(msg=str({}))])
"""


@pytest.mark.parametrize(
    "asked", ["input('which one? ')", "os.get_terminal_size(os.open(os.devnull, os.O_RDONLY))"]
)
def test_a_terminal_is_not_asked_for(
    orchestra_here: Command, folder: Path, monkeypatch: pytest.MonkeyPatch, asked: str
) -> None:
    monkeypatch.setattr(sys, "stdin", io.StringIO())
    (folder / "a.launch.py").write_text(_FILE.format(asked))
    found = orchestra_here("check", "--no-cache", "--format", "json", "a.launch.py", AMENT_PREFIX_PATH="")
    (problem,) = json.loads(found.stdout)
    assert (problem["severity"], "asks for a terminal" in problem["message"]) == ("note", True)


def test_what_fails_otherwise_stays_a_mistake(orchestra_here: Command, folder: Path) -> None:
    (folder / "a.launch.py").write_text(_FILE.format("os.readlink('.')"))
    found = orchestra_here("check", "--no-cache", "--format", "json", "a.launch.py")
    (problem,) = json.loads(found.stdout)
    assert (problem["severity"], "OSError" in problem["message"]) == ("error", True)
