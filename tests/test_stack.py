"""No depth of the stack makes calls slow. Memory that is mapped anew for each shows in page faults, whatever else runs."""

from __future__ import annotations

import os
import resource
import shutil
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from orchestra.stack import roomy

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

_CALLS = 200
_DEPTHS = 200  # of frames of eighty bytes or more: as much as a chunk of the interpreter's has
_FEW = 40
_CHUNK = "mmap(NULL, 16384, "


def _nothing() -> None:
    """Be called: with a frame that is larger than those that lead to it, so that at some depth it has no room."""


_nothing.__code__ = _nothing.__code__.replace(co_stacksize=100)


def _called_often() -> int:
    """Return how many pages were missing while a function was called often."""
    before = resource.getrusage(resource.RUSAGE_THREAD).ru_minflt
    for _ in range(_CALLS):
        _nothing()
    return resource.getrusage(resource.RUSAGE_THREAD).ru_minflt - before


def _at_depth(depth: int, function: Callable[[], int]) -> int:
    return function() if depth == 0 else _at_depth(depth - 1, function)


@roomy
def _with_room() -> int:
    return max(_at_depth(depth, _called_often) for depth in range(_DEPTHS))


def test_calls_have_room_at_every_depth() -> None:
    bare = max(_at_depth(depth, _called_often) for depth in range(_DEPTHS))
    assert bare >= _CALLS, "the interpreter does otherwise now: nobody needs this any more"
    assert _with_room() <= _FEW
    assert max(_at_depth(depth, _with_room) for depth in range(0, _DEPTHS, _DEPTHS // 10)) <= _FEW


def test_a_function_with_room_is_as_it_was() -> None:
    @roomy
    def added(first: int, *others: int, last: int = 0) -> int:
        """Return the sum."""
        return first + sum(others) + last

    assert (added(1, 2, 3, last=4), added.__name__, added.__doc__) == (10, "added", "Return the sum.")


@pytest.mark.skipif(
    shutil.which("strace") is None and not os.environ.get("CI"),
    reason="there is no strace(1) on this machine",
)
def test_a_command_has_room(tmp_path: Path) -> None:
    (tmp_path / "one.launch.yaml").write_text("launch:\n  - executable: {cmd: 'true'}\n")
    words = [*("strace", "-f", "-o", "trace", "-e", "trace=mmap,openat"), sys.executable, "-m", "orchestra"]
    given = {**os.environ, "ORCHESTRA_CACHE": str(tmp_path / "cache")}
    for command in ("plan", "check"):
        done = [*words, command, "one.launch.yaml"]
        subprocess.run(done, cwd=tmp_path, env=given, check=True, capture_output=True, timeout=100)
        trace = (tmp_path / "trace").read_text(errors="replace")
        _, found, ours = trace.partition("orchestra/__pycache__/stack")
        assert found
        assert ours.count(_CHUNK) <= _FEW
