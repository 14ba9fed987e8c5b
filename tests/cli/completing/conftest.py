"""A shell's surroundings: `orchestra` on the path, a folder with launch files, and a package."""

from __future__ import annotations

import os
import shlex
import sys
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

_WORLDS = """\
launch:
  - arg: {name: world, default: maze, choices: [maze, two words, "it's"], description: where to be}
  - arg: {name: headless, default: "true"}
"""


@pytest.fixture
def surroundings(folder: Path, prefix: Path, tmp_path: Path) -> dict[str, str]:
    """The environment of a shell; its working directory is `folder`."""
    (folder / "my worlds").mkdir()
    (folder / "my worlds" / "big.launch.yaml").write_text(_WORLDS)
    (folder / "small.launch.yaml").write_text(_WORLDS)
    (folder / "notes.txt").write_text("")
    (prefix / "share" / "demo" / "launch" / "talk.launch.yaml").write_text(_WORLDS)
    programs = tmp_path / "programs"
    programs.mkdir()
    (programs / "orchestra").write_text(
        f'#!/bin/sh\nexec {shlex.quote(sys.executable)} -P -m orchestra "$@"\n'
    )
    (programs / "orchestra").chmod(0o755)
    path = os.pathsep.join([str(programs), os.environ["PATH"]])
    return {**os.environ, "PATH": path, "AMENT_PREFIX_PATH": str(prefix), "HOME": str(folder)}
