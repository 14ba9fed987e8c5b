"""What a process costs, from outside: how often it was woken, how long it ran, what it holds."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True)
class Effort:
    """Since a process began: how often its threads gave up the processor of themselves, and seconds on a processor."""

    waits: int
    seconds: float


def effort(pid: int) -> Effort:
    """Return what the threads of a process have done so far (proc(5): status, schedstat)."""
    waits, nanoseconds = 0, 0
    for thread in Path(f"/proc/{pid}/task").iterdir():
        with contextlib.suppress(FileNotFoundError, ProcessLookupError):
            waits += _field(thread / "status", "voluntary_ctxt_switches")
            nanoseconds += int((thread / "schedstat").read_text().split()[0])
    return Effort(waits, nanoseconds / 1e9)


def sleeps(pid: int) -> bool:
    """Tell whether all threads of a process wait for something, and none of them for a processor (proc(5), stat)."""
    found = []
    for thread in Path(f"/proc/{pid}/task").iterdir():
        with contextlib.suppress(FileNotFoundError, ProcessLookupError):
            found.append((thread / "stat").read_text().rpartition(")")[2].split()[0])
    return set(found) == {"S"}


def descriptors(pid: int) -> int:
    """Return how many files a process has open."""
    return len(list(Path(f"/proc/{pid}/fd").iterdir()))


def memory(pid: int) -> int:
    """Return the bytes of a process that are in memory and its own: those of libraries are not counted."""
    return _field(Path(f"/proc/{pid}/status"), "RssAnon") * 1024


def most_memory(pid: int) -> int:
    """Return the most bytes that a process has ever had in memory."""
    return _field(Path(f"/proc/{pid}/status"), "VmHWM") * 1024


def _field(path: Path, name: str) -> int:
    lines = path.read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(f"{name}:"))
