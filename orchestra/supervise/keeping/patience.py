"""How long the keeper waits for the end of a run before it takes its supervisor for stuck.

A run ends within 5 s of a request, unless its description wants more time for a process. The supervisor then asks for
it, through memory that it shares with the keeper: nothing has to be read, and one that is stuck cannot get in the way.
It leaves there, too, what the run has come to, once that has been told: whatever becomes of it then changes nothing.

Stuck is who has had a processor and has not used it to end. Time in which the keeper itself stood still (a container
that is paused, a machine that is moved) does not count, nor does what a supervisor waits for a processor: a quota of a
container, or a hundred other programs, leave it a few milliseconds a second.
"""

from __future__ import annotations

import mmap
import time

from orchestra.supervise.keeping import proc

# The supervisor ends everything within 5 s of a request and gives up within 6 s. One that has done neither by now is
# stuck itself. In seconds.
USUAL = 8.0
# What it may take beyond the time that it has asked for.
_MARGIN = 3.0
# How often the keeper looks while it waits for the end, and how much later than that is no accident; in seconds.
LOOK_AGAIN = 0.5
_LATE = 0.5
# A supervisor ends a run in less than this of a processor's time; one that has used none for so long is not waiting for
# it; and beyond this nobody is waited for. In seconds.
_WORK = 2.0
_ASLEEP = 3.0
_LONGEST = 30.0
_SIZE = 16  # of two doubles, each of which the processor stores at once


class Patience:
    """Shared by keeper and supervisor: make it before the fork."""

    __slots__ = ("_shared",)

    def __init__(self) -> None:
        self._shared = memoryview(mmap.mmap(-1, _SIZE)).cast("d")  # until when; the status and 1 more

    def grant(self, seconds: float) -> None:
        """Let the keeper wait so long from now, and a little longer; in the supervisor."""
        self._shared[0] = time.monotonic() + seconds + _MARGIN

    def remaining(self) -> float:
        """Return how long the keeper is asked to wait from now, in seconds; negative where it is not."""
        return self._shared[0] - time.monotonic()

    def settle(self, status: int) -> None:
        """Leave what the run has come to; in the supervisor, when all has ended and that has been told."""
        self._shared[1] = status + 1.0

    @property
    def settled(self) -> int | None:
        """What the run has come to; None where it has not been told."""
        return int(self._shared[1]) - 1 if self._shared[1] else None


class Effort:
    """What a supervisor that was asked to end does with the processor; make it when it is asked, look now and then."""

    def __init__(self, pid: int) -> None:
        self._pid = pid
        self._asked_at = time.monotonic()
        self._first = self._latest = proc.run_time(pid)
        self._moved_at = self._asked_at

    def look(self) -> None:
        """See whether it has got further since the last look."""
        latest = proc.run_time(self._pid)
        if latest != self._latest:
            self._latest, self._moved_at = latest, time.monotonic()

    @property
    def starved(self) -> bool:
        """Whether it would have ended by now, had it had a processor."""
        now = time.monotonic()
        if self._first is None or self._latest is None or now > self._moved_at + _ASLEEP:
            return False
        return self._latest - self._first < _WORK and now < self._asked_at + _LONGEST


def standstill(began: float, seconds: float) -> float:
    """Return for how long we stood still, of a wait of so many seconds that began then."""
    late = time.monotonic() - began - seconds
    return late if late > _LATE else 0.0
