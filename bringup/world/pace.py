"""When the next tick is due: simulated time against real time."""

from __future__ import annotations

from dataclasses import dataclass

# A longer lag (a suspended process, a machine too slow) is not made up for: a burst of ticks would outrun the nodes
# that drive the robots.
LARGEST_LAG = 1.0


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
