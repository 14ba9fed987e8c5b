"""What a supervisor has in memory is bounded, whatever its processes write and whoever does not read it."""

from __future__ import annotations

import os
import signal
from typing import TYPE_CHECKING

import pytest

from orchestra.logs.writer import MOST
from tests.supervise.effort import most_memory
from tests.supervise.plans import after, launched, plan, process, ready_when, wait_for

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Process
    from tests.supervise.plans import Launched

# The interpreter with all that the supervisor imports, and what its writer, screen and streams may hold: texts of many
# short lines take several times their bytes. Measured at most: 77 MB.
_MOST_MEMORY = 80_000_000 + 4 * MOST
# In seconds: writing so much takes its time.
_PATIENCE = 300.0
_MILLION = 1_000_000
# Nothing of this line ends, fits the expression that is looked for, or is more than one character.
_LINE = "head -c {size} /dev/zero | tr '\\0' x"
_NOISE = "yes {word} | head -c {size}"


def shell(name: str, script: str, **changes: object) -> Process:
    return process(name, command=("/bin/sh", "-c", script), **changes)


def most(run: Launched) -> int:
    """Wait until all that was to be written has been; return the most memory that it took."""
    wait_for(lambda: run.of_kind("process_running", "last"), "the end of the noise", _PATIENCE)
    found = most_memory(run.own("orc-supervisor"))
    run.send(signal.SIGINT)
    assert run.wait(60.0) == 130
    return found


def written(run: Launched, name: str) -> int:
    """Count the bytes in the log files of a process."""
    return sum(path.stat().st_size for path in (run.directory / "logs").glob(f"{name}.log*"))


@pytest.mark.timeout(400)
@pytest.mark.parametrize("size", [10 * _MILLION, pytest.param(100 * _MILLION, marks=pytest.mark.long)])
def test_a_line_without_an_end(tmp_path: Path, size: int) -> None:
    line = shell(
        "line", _LINE.format(size=size), ready=ready_when(log="xy|y+$"), emulate_tty=size > 50 * _MILLION
    )
    last = shell("last", "exec sleep 1000", **after_all("line"))
    with launched(tmp_path, plan(line, last)) as run:
        assert most(run) < _MOST_MEMORY
        assert written(run, "line") == size


@pytest.mark.timeout(400)
@pytest.mark.parametrize("size", [2 * _MILLION, pytest.param(50 * _MILLION, marks=pytest.mark.long)])
def test_noise_that_nobody_reads(tmp_path: Path, size: int) -> None:
    """Three write as fast as they can, to files and to a screen that takes nothing."""
    words = ("a", "longer" * 20, "$(head -c 60000 /dev/zero | tr '\\0' x)")
    noisy = [shell(f"noisy{n}", _NOISE.format(word=word, size=size)) for n, word in enumerate(words)]
    last = shell("last", "exec sleep 1000", **after_all(*(each.id for each in noisy)))
    ours, theirs = os.pipe()
    try:
        with launched(tmp_path, plan(*noisy, last), stdout=theirs, stderr=theirs) as run:
            os.close(theirs)
            assert most(run) < _MOST_MEMORY
            for each in noisy:
                assert written(run, each.id) == size
    finally:
        os.close(ours)


def after_all(*names: str) -> dict[str, object]:
    """Return what lets a process begin when others have ended."""
    return {"depends_on": tuple(edge for name in names for edge in after(name, "exited"))}
