"""Keeps a complaint that could come at every update from being made each time.

rclpy's own throttling reads the caller's source at each call, which takes milliseconds: a filter that is late
because the machine is busy would be later still for saying so.
"""

from collections.abc import Callable
from time import monotonic


class Throttle:
    """Lets a complaint pass once within some seconds of real time."""

    def __init__(self, seconds: float, clock: Callable[[], float] = monotonic) -> None:
        self._seconds = seconds
        self._clock = clock
        self._passed: float | None = None

    def passes(self) -> bool:
        """Whether it is time to complain again; the time counts from here if it is."""
        now = self._clock()
        if self._passed is not None and now - self._passed < self._seconds:
            return False
        self._passed = now
        return True
