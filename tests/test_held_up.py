"""A test in which an extension keeps the interpreter to itself ends, and the others go on."""

import subprocess
import sys
from pathlib import Path

_FILE = """
import itertools
import pytest

@pytest.mark.timeout(0.5)
def test_held():
    sum(itertools.repeat(0))  # in C, where the lock of the interpreter is not given back

def test_other():
    pass
"""


def test_a_test_that_never_comes_back_is_told_and_the_others_go_on(tmp_path: Path) -> None:
    file = tmp_path / "test_it.py"
    file.write_text(_FILE)
    done = subprocess.run(
        [
            sys.executable,
            "-m",
            "pytest",
            "-q",
            "-p",
            "tests.held_up",
            "-p",
            "no:cacheprovider",
            "-n",
            "1",
            str(file),
        ],
        cwd=tmp_path,
        env={
            "PATH": "/usr/bin:/bin",
            "PYTHONPATH": str(Path(__file__).parents[1]),
            "ORCHESTRA_TEST_HELD_UP": "0.5",
        },
        capture_output=True,
        text=True,
        timeout=100,
        check=False,
    )
    assert "1 failed, 1 passed" in done.stdout
    assert "crashed while running 'test_it.py::test_held'" in done.stdout
