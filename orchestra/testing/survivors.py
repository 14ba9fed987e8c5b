"""What a run has left behind, told by the mark in the environment with which a process was started."""

from __future__ import annotations

import os

from orchestra.dataclass import dataclass
from orchestra.supervise.keeping import proc
from orchestra.supervise.keeping.marks import PROCESS, RUN


@dataclass(frozen=True, slots=True)
class Survivor:
    """A living process of a run, and the process of the plan that it belongs to."""

    pid: int
    process: str | None
    command: str

    def __str__(self) -> str:
        return f"{self.process or 'a process of the run itself'}: {self.command} (pid {self.pid})"


def survivors(run: str) -> tuple[Survivor, ...]:
    """Return the living processes that carry the mark of a run."""
    found = []
    for pid in proc.pids():
        marked, process = proc.marks(pid, (RUN, PROCESS))
        facts = proc.stat(pid) if marked == run else None
        if facts and facts.state not in "ZX" and pid != os.getpid():
            found.append(Survivor(pid, process, proc.command(pid)))
    return tuple(found)
