"""What a run whose keeper and supervisor are dead has left: found by its marks, and ended."""

from __future__ import annotations

import contextlib
import os
import select
import signal
import time
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.logs.names import shown
from orchestra.supervise.keeping import proc
from orchestra.supervise.keeping.marks import PROCESS, RUN, run_of

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable

# How long what is left may take after each signal, in seconds.
_LADDER = ((signal.SIGINT, 2.0), (signal.SIGTERM, 1.5), (signal.SIGKILL, 1.5))
_LOOK_AGAIN = 0.1


@dataclass(frozen=True, slots=True)
class Remnant:
    """A process that a dead run has left. `process` is the id in the plan to which it belonged, where that is known."""

    pid: int
    birth: int
    run: str
    process: str | None
    command: str

    def __str__(self) -> str:
        name = shown(self.process) if self.process else self.command
        return f"{name} (pid {self.pid})"


def remnants(runs: Iterable[str]) -> list[Remnant]:
    """Return the living processes with the marks of these runs, or their number, and all that is below them.

    Neither this process nor what it was started by is among them: a shell that a run left may well be where it is asked
    for what is left.
    """
    marks = frozenset(runs)
    found: dict[int, Remnant] = {}
    spared = _ourselves()
    for pid in sorted(set(proc.pids()) - spared):
        run, process = proc.marks(pid, (RUN, PROCESS))
        number = None if run in marks else proc.lock_limit(pid)
        run = run if number is None else run_of(number, marks)
        if run in marks and (remnant := _remnant(pid, str(run), process)):
            found[pid] = remnant
    for remnant in [*found.values()]:
        for pid in proc.descendants(remnant.pid):
            below = None if pid in found or pid in spared else _remnant(pid, remnant.run, remnant.process)
            if below:
                found[pid] = below
    return list(found.values())


def _remnant(pid: int, run: str, process: str | None) -> Remnant | None:
    birth = proc.birth(pid)
    return None if birth is None else Remnant(pid, birth, run, process or None, proc.command(pid))


def _ourselves() -> set[int]:
    found = set()
    pid = os.getpid()
    while pid and (facts := proc.stat(pid)):
        found.add(pid)
        pid = facts.parent
    return found


def end(runs: Collection[str]) -> list[Remnant]:
    """End what these runs have left, politely first; return what is left all the same."""
    left = remnants(runs)
    for number, seconds in _LADDER:
        deadline = time.monotonic() + seconds
        told: set[Remnant] = set()
        while left and time.monotonic() < deadline:
            for remnant in left:
                if remnant not in told:
                    _tell(remnant, number)
            told.update(left)
            _await(left, min(_LOOK_AGAIN, deadline - time.monotonic()))
            left = remnants(runs)
    return left


def _tell(remnant: Remnant, number: int) -> None:
    """Signal a process, and nobody else who was given its number; a stopped one is woken for it."""
    try:
        process = os.pidfd_open(remnant.pid)
    except ProcessLookupError:
        return
    with contextlib.suppress(ProcessLookupError, PermissionError):
        if proc.birth(remnant.pid) == remnant.birth:
            signal.pidfd_send_signal(process, number)
            signal.pidfd_send_signal(process, signal.SIGCONT)
    os.close(process)


def _await(left: Collection[Remnant], seconds: float) -> None:
    """Wait until one of them has ended, at most some seconds."""
    poll = select.poll()
    processes = []
    for remnant in left:
        with contextlib.suppress(ProcessLookupError):
            processes.append(os.pidfd_open(remnant.pid))
            poll.register(processes[-1], select.POLLIN)
    if len(processes) == len(left):
        poll.poll(max(0.0, seconds) * 1000)
    for process in processes:
        os.close(process)
