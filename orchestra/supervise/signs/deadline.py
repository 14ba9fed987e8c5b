"""A limit of time that every sign of life puts off."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.supervise.loop import Loop, Timer

# A timer that comes so much too late, in seconds or as a share of the period, says that we ourselves were stopped, or
# the machine overloaded: what others did meanwhile cannot be judged.
LATE, _LATE_SHARE = 1.0, 0.25


class Deadline:
    """Calls `expired` when there has been no sign for a period.

    One period in which we ourselves were stuck does not count, but the next one does: who hangs may be what keeps the
    machine from everything else. A sign costs nothing but a look at the clock: one timer runs, whatever comes.
    """

    def __init__(self, loop: Loop, expired: Callable[[], None]) -> None:
        self._loop = loop
        self._expired = expired
        self._period = 0.0
        self._last = 0.0
        self._excused = False
        self._timer: Timer | None = None

    @property
    def runs(self) -> bool:
        """Whether a sign is awaited."""
        return self._timer is not None

    def begin(self, period: float) -> None:
        """Await a sign within so many seconds, from now on again and again."""
        self.end()
        self._period = period
        self.sign()
        self._timer = self._loop.call_later(period, self._due)

    def sign(self) -> None:
        """There was a sign."""
        self._excused = False
        self._last = self._loop.clock()

    def end(self) -> None:
        """Await nothing any more."""
        if self._timer:
            self._timer.cancel()
            self._timer = None

    def _due(self) -> None:
        now = self._loop.clock()
        late = now - self._timer.due if self._timer else 0.0
        if late > min(LATE, _LATE_SHARE * self._period) and not self._excused:
            self.begin(self._period)
            self._excused = True
            return
        left = self._last + self._period - now
        if left > 0:
            self._timer = self._loop.call_later(left, self._due)
            return
        self._timer = None
        self._expired()
