"""What files share is looked at once in a process that is watched, and each result depends on it."""

from __future__ import annotations

import subprocess
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

_PROGRAM = """
import os, sys
from orchestra.witness.observing import observer
from orchestra.witness.once import once
folder, calls = sys.argv[1], []
def look():
    calls.append(1)
    return os.path.isfile(f"{folder}/file")
watching = observer()
watching.install()
told = []
for unknown in (False, False, True, False):
    watching.begin({})
    if unknown:
        watching.unknown("somebody writes files")
    once(("file",), look)
    record = watching.end()
    told.append((len(calls), f"{folder}/file" in record.looks.get("mode", {})))
print(told)
"""


def test_a_look_is_shared_recorded_and_forgotten(tmp_path: Path) -> None:
    words = [sys.executable, "-c", _PROGRAM, str(tmp_path)]
    done = subprocess.run(words, check=True, capture_output=True, text=True)
    assert done.stdout.strip() == str([(1, True), (1, True), (2, True), (3, True)])
