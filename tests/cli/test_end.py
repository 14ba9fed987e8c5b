"""A command that reads files ends as the interpreter does, but for taking apart what it has made."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

_FILE = "launch:\n- executable: {cmd: echo hello, name: greet}\n"
# What the interpreter imports when it starts: somebody who wants to know of its end.
_HOOK = 'import atexit\natexit.register(lambda: print("last words"))\n'


def _ended(folder: Path, *words: str, python: tuple[str, ...] = ()) -> subprocess.CompletedProcess[str]:
    (folder / "sitecustomize.py").write_text(_HOOK)
    (folder / "main.launch.yaml").write_text(_FILE)
    paths = [str(folder), *filter(None, [os.environ.get("PYTHONPATH")])]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}
    environment.pop("PYTHONUNBUFFERED", None)  # which the C library obeys, too
    return subprocess.run(
        [sys.executable, *python, "-m", "orchestra", *words],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=90,
        check=False,
    )


@pytest.mark.parametrize(
    ("words", "status"),
    [(("plan", "main.launch.yaml"), 0), (("plan", "absent.yaml"), 2), (("check", "."), 0)],
    ids=str,
)
def test_what_is_registered_for_the_end_is_called_and_its_words_are_written(
    tmp_path: Path, words: tuple[str, ...], status: int
) -> None:
    ended = _ended(tmp_path, *words)
    assert ended.returncode == status
    assert ended.stdout.endswith("last words\n")
    assert ended.stdout.count("last words") == 1


def test_what_code_of_launch_files_registers_and_writes_by_the_c_library_is_not_lost(tmp_path: Path) -> None:
    (tmp_path / "main.launch.py").write_text(
        "import atexit, ctypes\n"
        "from launch import LaunchDescription\n"
        "def generate_launch_description():\n"
        "    ctypes.CDLL(None).printf(b'words of C\\n')\n"
        "    atexit.register(lambda: print('the end of the code'))\n"
        "    return LaunchDescription()\n"
    )
    ended = _ended(tmp_path, "plan", "main.launch.py")
    assert (ended.returncode, ended.stdout.count("last words")) == (0, 1)
    assert "words of C" in ended.stderr
    assert "the end of the code" in ended.stdout + ended.stderr


def test_a_profiler_sees_the_end(tmp_path: Path) -> None:
    ended = _ended(tmp_path, "plan", "main.launch.yaml", python=("-m", "cProfile"))
    assert ended.returncode == 0
    assert "function calls" in ended.stdout
