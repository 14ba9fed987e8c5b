"""When the next tick is due: simulated time against real time."""

from __future__ import annotations

from dataclasses import dataclass

from bringup.world.model import TICKS_PER_SECOND

TICK = 1.0 / TICKS_PER_SECOND
# A longer lag (a process that was stopped, a machine too slow for the world) is not made up for, but told.
LARGEST_LAG = 10.0
# How much faster than asked ticks may follow one another to make up for a lag: a burst without pause would outrun the
# nodes that drive the robots.
CATCH_UP = 2.0


@dataclass(frozen=True, slots=True)
class Pace:
    """At the real time `since` (seconds, monotonic) the simulated time was `time`; since then it runs at `speed`."""

    since: float
    time: float
    speed: float


def wait(pace: Pace, now: float, time: float) -> float:
    """Real seconds until the simulated `time` is due, negative when late; speed 0 never waits."""
    if pace.speed == 0.0:
        return 0.0
    return pace.since + (time - pace.time) / pace.speed - now


def kept(pace: Pace, now: float, time: float, speed: float) -> Pace:
    """The pace to go on with: a new one from here on if the speed has changed or the lag is too long."""
    if speed != pace.speed or wait(pace, now, time) < -LARGEST_LAG:
        return Pace(now, time, speed)
    return pace


class Metronome:
    """Says when ticks are due. `lag` is how many real seconds the next one is late, `lost` what was given up of it."""

    def __init__(self, now: float, speed: float) -> None:
        self._pace = Pace(now, 0.0, speed)
        self._last = now
        self.lag = self.lost = 0.0

    def wait(self, now: float, time: float, speed: float) -> float:
        """Real seconds until the tick that begins at the simulated `time` is due; at most 0 if it is."""
        if time < self._pace.time:
            self._pace = Pace(now, time, speed)
        pace = kept(self._pace, now, time + TICK, speed)
        if pace is not self._pace and speed == self._pace.speed:
            self.lost += -wait(self._pace, now, time + TICK)
        self._pace = pace
        due = wait(pace, now, time + TICK)
        self.lag = max(0.0, -due)
        if due > 0.0 or speed == 0.0:
            return due
        return self._last + TICK / speed / CATCH_UP - now

    def hold(self, now: float, time: float) -> None:
        """Simulated time stands still on purpose: that is not made up for."""
        self._pace = Pace(now, time, self._pace.speed)
        self.lag = 0.0

    def ticked(self, now: float) -> None:
        """A tick has begun."""
        self._last = now
