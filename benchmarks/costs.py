"""What processes have cost: seconds on a processor, memory, wake-ups."""

from __future__ import annotations

import contextlib
import os
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

_TICK = os.sysconf("SC_CLK_TCK")
_GONE = (FileNotFoundError, ProcessLookupError)


@dataclass(frozen=True, slots=True)
class Process:
    """A process as proc(5) shows it; `seconds` on a processor are its own and those of children it has waited for."""

    pid: int
    parent: int
    name: str
    seconds: float


def tree(root: int) -> list[Process]:
    """Return a process and all that descend from it, as far as the line of parents is unbroken."""
    children: dict[int, list[Process]] = defaultdict(list)
    found: dict[int, Process] = {}
    for folder in Path("/proc").iterdir():
        if folder.name.isdecimal():
            with contextlib.suppress(*_GONE):
                process = _read(folder)
                found[process.pid] = process
                children[process.parent].append(process)
    reached = [found[root]] if root in found else []
    for process in reached:
        reached += children[process.pid]
    return reached


def memory(pid: int) -> float:
    """Return the proportional share of memory of a process, in MiB; 0 where it has ended."""
    with contextlib.suppress(*_GONE):
        for line in Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines():
            if line.startswith("Pss:"):
                return int(line.split()[1]) / 1024
    return 0.0


def waits(pid: int) -> int:
    """Return how often the threads of a process have waited for something so far."""
    count = 0
    for thread in Path(f"/proc/{pid}/task").iterdir():
        for line in (thread / "status").read_text().splitlines():
            if line.startswith("voluntary_ctxt_switches:"):
                count += int(line.split()[1])
    return count


def _read(folder: Path) -> Process:
    before, _, rest = (folder / "stat").read_text().rpartition(")")
    fields = rest.split()
    return Process(
        int(folder.name), int(fields[1]), before.partition("(")[2], sum(map(int, fields[11:15])) / _TICK
    )
