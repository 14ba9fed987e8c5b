"""Tells of updates that take longer than their period: when that begins, and when it is over, how many there were.

A busy machine takes the processor away for longer than a period now and then. To tell of each such update, as
robot_localization does, would fill the log and say less than their number does.
"""

# Seconds of real time without a long update after which the rate is met again.
QUIET = 30.0


class Lateness:
    """Whether updates take too long at the moment, and how many did since that began."""

    def __init__(self, period: float) -> None:
        self._period = period
        self._last: float | None = None
        self._count = 0
        self._longest = 0.0

    def begins(self, took: float, now: float) -> str | None:
        """Note how long an update took (s) at the time `now` (s); gives what to say if it is the first of many."""
        if took <= self._period:
            return None
        first = self._last is None
        self._last = now
        self._count += 1
        self._longest = max(self._longest, took)
        if not first:
            return None
        return f"failed to meet update rate: an update took {took:.4f} s of {self._period:.4f} s"

    def ends(self, now: float) -> str | None:
        """Give what to say when no update has taken too long for a while."""
        if self._last is None or now - self._last < QUIET:
            return None
        updates = "1 update" if self._count == 1 else f"{self._count} updates"
        text = f"the update rate is met again: {updates} took too long, {self._longest:.4f} s at most"
        self._last, self._count, self._longest = None, 0, 0.0
        return text
