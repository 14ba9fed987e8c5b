"""Programs that crash at once and are to be respawned: what they cost, and that the run can be ended meanwhile."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.testing.launching import launched
from tests.pressure import Deadline

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.testing.run import Run

MOST_STARTS = 5
WITHIN = 10.0
END_WITHIN = 3.0
# Ctrl-C in the first pause, which is none at all, in the next ones, and just when a program is being started.
MOMENTS = (0.0, 0.3, 1.0)


def storm(count: int) -> dict[str, Any]:
    """Return a launch file with programs that have crashed before they have begun, and one that has not."""
    crash = [sys.executable, "-S", "-E", "-c", "raise SystemExit(1)"]
    crashing = [
        {"executable": {"cmd": crash, "name": f"crashing{n}", "respawn": True, "output": "log"}}
        for n in range(count)
    ]
    return {"launch": [*crashing, {"executable": {"cmd": ["sleep", "1000"], "name": "steady"}}]}


def starts(run: Run, name: str) -> list[float]:
    """Return when a program was started, on the monotonic clock."""
    return [
        event.monotonic for event in run.events if (event.kind, event.process) == ("process_starting", name)
    ]


def test_a_crash_at_once_costs_five_starts_in_ten_seconds(tmp_path: Path) -> None:
    with launched(storm(3), home=tmp_path) as run:
        run.wait_for_event("process_starting", "crashing2")
        time.sleep(WITHIN + 0.5)  # that long is what is measured
        for name in ("crashing0", "crashing1", "crashing2"):
            moments = starts(run, name)
            # A machine that is busy starts them later, never more often.
            assert 1 < len([moment for moment in moments if moment < moments[0] + WITHIN]) <= MOST_STARTS
        assert_ends(run)


@pytest.mark.parametrize("moment", MOMENTS)
def test_ctrl_c_ends_a_storm(tmp_path: Path, moment: float) -> None:
    with launched(storm(20), home=tmp_path) as run:
        run.wait_for_event("process_restarting")
        time.sleep(moment)
        assert_ends(run)


def assert_ends(run: Run) -> None:
    """Press Ctrl-C: the end does not take long, by the events, for a busy machine is slow to tell us."""
    deadline = Deadline(END_WITHIN)
    assert run.stop() == 130, run.output
    began, ended = (run.wait_for_event(kind).monotonic for kind in ("run_stopping", "run_ended"))
    assert ended - began < deadline.allowed
