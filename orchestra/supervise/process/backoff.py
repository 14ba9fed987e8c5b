"""Whether an ended process starts again, and after how long."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass

if TYPE_CHECKING:
    from orchestra.values import Restart

# A process that asks for no delay starts again at once the first time; the second pause in a row is this long, and
# grows. So a program that crashes at once costs five starts in its first ten seconds: at 0, 0, 1, 3 and 7 s.
_FIRST_GROWN_DELAY = 1.0
# Beyond this the cap has long decided.
_MOST_STEPS = 1000


@dataclass(frozen=True, slots=True)
class Again:
    """Start again after `delay` seconds, with the count of short runs in a row as it now stands."""

    delay: float
    jitter: float
    short_runs: int


def decide(restart: Restart | None, *, success: bool, uptime: float, short_runs: int) -> Again | None:
    """Return when to start again, None for not at all.

    The budget counts runs in a row shorter than `min_uptime`, not starts in a window: once pauses have grown, a window
    never fills, and the limit would never be reached.
    """
    if restart is None or restart.policy == "no" or (restart.policy == "on-failure" and success):
        return None
    short_now = short_runs + 1 if uptime < restart.min_uptime else 0
    if restart.budget is not None and short_now > restart.budget:
        return None
    return Again(_delay(restart, short_now), restart.jitter, short_now)


def _delay(restart: Restart, short_runs: int) -> float:
    if short_runs <= 1:
        return restart.delay
    grown = max(restart.delay * restart.growth, _FIRST_GROWN_DELAY)
    for _ in range(min(short_runs - 2, _MOST_STEPS)):
        grown *= restart.growth
    return max(restart.delay, min(grown, restart.max_delay))
