"""How the node ends, and what it refuses to begin."""

from __future__ import annotations

import re
import signal
import time
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextlib import AbstractContextManager

    Start = Callable[..., AbstractContextManager[Any]]

DOMAIN = 29


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_run_as_if_it_were_over(start: Start, number: int, tmp_path: Path) -> None:
    picture = tmp_path / "run.png"
    with start(DOMAIN, "-p", "status_period:=0.2", "-p", f"picture:={picture}", "-p", "world:=maze") as run:
        run.wait_for("robot2: pose")
        asked = time.monotonic()
        run.process.send_signal(number)
        status, said = run.end()
        took = time.monotonic() - asked
    assert (status, "Traceback" in said) == (0, False)
    assert "real-time factor" in said
    assert picture.exists()
    # It takes a third of a second; the bound allows for a machine that has other things to do.
    assert took < 5.0


def test_a_signal_during_the_imports_is_an_end_too(start: Start) -> None:
    with start(DOMAIN) as run:
        maps = Path(f"/proc/{run.process.pid}/maps")
        deadline = time.monotonic() + 60.0
        while "rclpy" not in maps.read_text():
            assert time.monotonic() < deadline
        run.process.send_signal(signal.SIGINT)
        status, said = run.end()
    assert (status, "Traceback" in said) == (0, False)


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["-p", "speed:=-1.0"], "speed out of range"),
        (["-p", "speed:=fast"], "'speed' to 'fast' of type 'STRING'"),
        (["-p", "world:=moon"], "no world is called 'moon'; there are arena, maze"),
        (["-p", "robots:=[a, a]"], "'a' stands there twice"),
        (["-p", "headless:=false"], "no window can be opened"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(start: Start, arguments: list[str], reason: str) -> None:
    with start(DOMAIN, *arguments, DISPLAY="", WAYLAND_DISPLAY="") as run:
        status, said = run.end()
    assert status == 1
    assert reason in said
    assert "Traceback" not in said
    assert len(said.splitlines()) == 1


def test_a_picture_that_cannot_be_written_is_an_error_and_no_crash(start: Start) -> None:
    with start(DOMAIN, "-p", "duration:=1", "-p", "speed:=0", "-p", "picture:=/proc/none/run.png") as run:
        status, said = run.end()
    assert status == 0
    assert "[ERROR]" in said
    assert "the picture cannot be written" in said


def test_a_run_without_pace_is_faster_than_real_time(start: Start) -> None:
    with start(DOMAIN, "-p", "duration:=20", "-p", "speed:=0.0", "-p", "robots:=[solo]") as run:
        status, said = run.end()
    factor = re.search(r"real-time factor (\S+)", said)
    assert status == 0
    assert factor is not None
    assert float(factor[1]) > 1.0
    assert "solo: 0 contacts" in said


_BEHIND = re.compile(
    r"\[(\d+\.\d+)\] .*behind real time: factor (\S+) instead of 1000, (\S+) s late(?:, (\S+) s given up before)?"
)


def _agree(earlier: re.Match[str], later: re.Match[str]) -> bool:
    """Tell whether as much has been lost between two lines as there is between their stamps.

    Next to nothing of a thousand seconds has passed in each: the rest is missing.
    """
    passed = float(later[1]) - float(earlier[1])
    lost = [float(line[3]) + float(line[4] or 0.0) for line in (earlier, later)]
    return passed > 1.0 and lost[1] - lost[0] == pytest.approx(passed, rel=0.2)


def test_a_run_that_does_not_keep_up_says_by_how_much(start: Start) -> None:
    """What it says of its speed and of its lag agrees with the clock of the machine.

    Not of every two lines: a process that has to wait between looking at the clock and writing says both.
    """
    lines: list[re.Match[str]] = []
    with start(DOMAIN, "-p", "speed:=1000.0", "-p", "status_period:=0.5") as run:
        while not any(_agree(earlier, later) for earlier, later in combinations(lines, 2)):
            assert len(lines) < 20, [line[0] for line in lines]
            found = _BEHIND.search(run.wait_for("behind real time"))
            assert found is not None
            lines.append(found)
        run.process.send_signal(signal.SIGINT)
        status, said = run.end()
    assert status == 0
    whole = re.search(r"simulated (\S+) s in (\S+) s", said)
    assert whole is not None
    factors = [float(line[2]) for line in _BEHIND.finditer(said)]
    # What it does before the first line and behind the last one may be much quicker or slower.
    assert 0.2 * min(factors) < float(whole[1]) / float(whole[2]) < 5.0 * max(factors)


@pytest.mark.long
def test_a_process_that_was_stopped_loses_no_simulated_time(start: Start) -> None:
    # Slow, so that a machine that has other things to do can follow.
    with start(DOMAIN, "-p", "speed:=0.2", "-p", "status_period:=0.2") as run:
        run.wait_for("robot1: pose")
        run.process.send_signal(signal.SIGSTOP)
        time.sleep(1.0)
        run.process.send_signal(signal.SIGCONT)
        run.wait_for("behind real time")
        # Three times the status of two robots without a word of it: it is in step again.
        quiet = 0
        while quiet < 6:
            quiet = 0 if "behind real time" in run.wait_for("[simulation]: ") else quiet + 1
        run.process.send_signal(signal.SIGINT)
        status, said = run.end()
    whole = re.search(r"simulated (\S+) s in (\S+) s", said)
    assert status == 0
    assert whole is not None
    # A lag of up to half a second is not told.
    assert float(whole[2]) - float(whole[1]) / 0.2 < 0.9
    assert "given up" not in said
