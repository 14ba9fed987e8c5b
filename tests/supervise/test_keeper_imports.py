"""The keeper is small: what it imports before it forks is counted."""

from __future__ import annotations

import json
import subprocess
import sys

# What belongs to the interpreter and its smallest extensions. Whatever is new here is loaded before every first fork.
ALLOWED = {
    "__future__",
    "_ctypes",
    "_struct",
    "contextlib",
    "ctypes",
    "ctypes._endian",
    "faulthandler",
    "mmap",
    "select",
    "signal",
    "struct",
    "termios",
}
OURS = 18
PROGRAM = """
import json, sys
before = set(sys.modules)
import orchestra.supervise.run
print(json.dumps(sorted(set(sys.modules) - before)))
"""


def test_the_keeper_imports_next_to_nothing() -> None:
    told = subprocess.run([sys.executable, "-P", "-c", PROGRAM], capture_output=True, check=True)
    new = {name for name in json.loads(told.stdout) if not name.startswith("importlib")}
    ours = {name for name in new if name.startswith("orchestra")}
    assert new - ours <= ALLOWED
    assert len(ours) <= OURS, sorted(ours)
    assert all(name == "orchestra" or name.startswith("orchestra.supervise") for name in ours)
