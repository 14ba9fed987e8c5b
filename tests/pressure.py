"""What is promised within a time is promised for a machine on which programs can run: a busy one has longer."""

from __future__ import annotations

import time
from pathlib import Path


class Deadline:
    """So many seconds from now, and those in which a program has waited for a processor: up to three times as many."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self._began, self._waited = time.monotonic(), _pressure()

    @property
    def allowed(self) -> float:
        """How many seconds it comes to by now."""
        return self._seconds + min(2 * self._seconds, _pressure() - self._waited)

    @property
    def is_over(self) -> bool:
        """Whether it has passed."""
        return time.monotonic() - self._began > self.allowed


def _pressure() -> float:
    """Return for how many seconds in all a program of this machine has waited for a processor; 0 if nobody tells (PSI)."""
    try:
        first = Path("/proc/pressure/cpu").read_text("ascii").splitlines()[0]
    except OSError:
        return 0.0
    return int(first.rpartition("total=")[2]) / 1e6
