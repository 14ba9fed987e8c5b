"""What the fork server has loaded leaves no thread at work that its first fork would end."""

from __future__ import annotations

import subprocess
import sys

COUNTED = """
import os, sys
from orchestra.ros.warm.algebra import load_algebra
if sys.argv[1] == "early":
    load_algebra()
import numpy
before = set(os.listdir("/proc/self/task"))
if os.fork() == 0:
    os._exit(0)
os.wait()
ended = before - set(os.listdir("/proc/self/task"))
product = float((numpy.ones((300, 300)) @ numpy.ones((300, 300))).sum())
print(len(ended), product, len(os.listdir("/proc/self/task")) - len(before))
"""


def counted(how: str) -> list[str]:
    command = [sys.executable, "-W", "ignore", "-c", COUNTED, how]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()


def test_threads_of_numpy_are_ended_before_they_look_for_work() -> None:
    ended, product, _ = counted("early")
    assert (ended, product) == ("0", "27000000.0")


def test_numpy_has_all_of_its_threads_where_it_multiplies() -> None:
    """As many as it has that was loaded by itself, which has ended and begun them again by the same fork."""
    assert int(counted("early")[2]) == int(counted("late")[0])
