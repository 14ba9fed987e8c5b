"""The last look: nothing of the run may be left when its supervisor ends."""

from __future__ import annotations

import os
import signal
from typing import TYPE_CHECKING

from orchestra.supervise.keeping import proc
from orchestra.supervise.keeping.kin import send_to_groups
from orchestra.supervise.keeping.marks import RUN
from orchestra.supervise.keeping.sweeping import kill_below

if TYPE_CHECKING:
    from orchestra.supervise.loop import Loop
    from orchestra.supervise.surroundings import Surroundings

_POLITE = 1.0
_GIVE_UP_AFTER = 0.7
_LOOK_AGAIN = 0.05


def leftovers(run_id: str) -> list[int]:
    """Return every process below this one, and every one that carries the run's mark, wherever it hangs now."""
    ourselves = os.getpid()
    below = {} if proc.childless() else dict.fromkeys(proc.descendants(ourselves))
    marked = [
        pid
        for pid in proc.pids()
        if pid != ourselves and pid not in below and proc.marks(pid, (RUN,)) == (run_id,)
    ]
    return [*below, *marked]


def end_leftovers(around: Surroundings, run_id: str, *, remaining: float | None) -> dict[int, str]:
    """End what is left, with SIGTERM while `remaining` seconds allow it and SIGKILL then; name what stays."""
    polite = _POLITE if remaining is None else min(remaining, _POLITE)
    around.kin.refresh()
    left = leftovers(run_id)
    for pid in left:
        around.recorder.record("left_behind", pid=pid, command=proc.command(pid))
        around.journal.say(f"something was left behind and is ended: {proc.command(pid)} (pid {pid})")
    for number, seconds in ((signal.SIGTERM, polite), (signal.SIGKILL, _GIVE_UP_AFTER)):
        if (left or not proc.childless()) and seconds > 0:
            _tell(left, number)
            left = _await(around, run_id, seconds, again=number == signal.SIGKILL)
    return {pid: f"{proc.command(pid)} (pid {pid})" for pid in left}


def _tell(pids: list[int], number: int) -> None:
    """Signal children of ours with their groups, and the others one by one."""
    ours = set(proc.children(os.getpid()))
    send_to_groups(ours.intersection(pids), number)
    for pid in set(pids) - ours:
        try:
            os.kill(pid, number)
        except (ProcessLookupError, PermissionError):
            continue


def _await(around: Surroundings, run_id: str, seconds: float, *, again: bool) -> list[int]:
    """Wait until nothing is left, at most some seconds; `again` kills what turns up meanwhile."""
    loop = around.loop
    deadline = loop.clock() + seconds
    while True:
        around.kin.refresh()
        left = leftovers(run_id)
        if (not left and proc.childless()) or loop.clock() >= deadline:
            return left
        if again:
            kill_below(os.getpid(), around.kin.refresh)
            _tell(left, signal.SIGKILL)
        _pause(loop)


def _pause(loop: Loop) -> None:
    timer = loop.call_later(_LOOK_AGAIN, lambda: None)
    loop.run_once()
    timer.cancel()
