"""How fast simulated time goes, and so how long a node can rest until its next tick.

A simulation sends its clock oftener than a filter has ticks, and each clock message that brings no tick costs a
wake-up. So for most of the time to the next tick, as far as the last ones tell, the node does not look at the clock.
A simulation that suddenly runs faster makes one tick late; what has arrived by then is used at that tick.
"""

from bringup.filter.settings import NANOSECONDS

# Of the time that the next tick is expected to be away; the rest is for simulations that do not run evenly.
_SHARE = 0.6
# Seconds for which a call of a service, or the order to end, can wait.
_LONGEST = 0.0125


class Pace:
    """The pace of simulated time against real time (s), by the last two ticks."""

    def __init__(self) -> None:
        self._simulated = 0
        self._real = 0.0
        # Real seconds for a simulated one.
        self._slowness = 0.0

    def note(self, now: int, real: float) -> None:
        """Note a tick at the simulated time `now` (ns)."""
        passed = (now - self._simulated) / NANOSECONDS
        self._slowness = (real - self._real) / passed if passed > 0.0 else 0.0
        self._simulated, self._real = now, real

    def rest(self, to_go: int, real: float) -> float:
        """Tell how long to rest from the time `real` (s) on, if the next tick is `to_go` (ns) after the last look.

        Never longer than if time went as fast as real time: one that stands still may go on at any moment.
        """
        expected = to_go / NANOSECONDS * min(self._slowness, 1.0)
        return max(0.0, self._real + min(expected * _SHARE, _LONGEST) - real)
