"""How long the keeper waits for the end of a run before it takes its supervisor for stuck.

A run ends within 5 s of a request, unless its description wants more time for a process. The supervisor then asks for
it, through memory that it shares with the keeper: nothing has to be read, and one that is stuck cannot get in the way.
"""

from __future__ import annotations

import mmap
import time

# The supervisor ends everything within 5 s of a request and gives up within 6 s. One that has done neither by now is
# stuck itself. In seconds.
USUAL = 8.0
# What it may take beyond the time that it has asked for.
_MARGIN = 3.0
_SIZE = 8  # of a double, which the processor stores at once


class Patience:
    """Shared by keeper and supervisor: make it before the fork."""

    __slots__ = ("_until",)

    def __init__(self) -> None:
        self._until = memoryview(mmap.mmap(-1, _SIZE)).cast("d")

    def grant(self, seconds: float) -> None:
        """Let the keeper wait so long from now, and a little longer; in the supervisor."""
        self._until[0] = time.monotonic() + seconds + _MARGIN

    def remaining(self) -> float:
        """Return how long the keeper is asked to wait from now, in seconds; negative where it is not."""
        return self._until[0] - time.monotonic()
