"""When the next update is due, on ROS time."""

from rclpy.node import Node

from bringup.filter.settings import NANOSECONDS


def next_tick(due: int, now: int, period: int) -> int:
    """Find the first tick after `now` in the rhythm of `due`; a clock that has gone back starts a new rhythm."""
    if now < due - period:
        return now + period
    return due + period * ((now - due) // period + 1)


class Ticks:
    """The ticks of one node, on simulated time or the machine's, whichever `use_sim_time` says at the moment."""

    def __init__(self, node: Node, frequency: float) -> None:
        self._clock = node.get_clock()
        self._period = round(NANOSECONDS / frequency)
        self._due: int | None = None
        self._seen = 0

    def take(self) -> int | None:
        """Give the time (ns) if an update is due now, and each tick only once."""
        now = self._seen = int(self._clock.now().nanoseconds)
        if now == 0:  # Simulated, and no clock message has come.
            return None
        if self._due is not None and self._due - self._period <= now < self._due:
            return None
        self._due = next_tick(now if self._due is None else self._due, now, self._period)
        return now

    @property
    def to_go(self) -> int:
        """How far the next tick is away by the time of the last look (ns)."""
        return 0 if self._due is None else self._due - self._seen

    def left(self) -> int | None:
        """Tell how long the next tick is away (ns); None if only a clock message can bring it."""
        if self._clock.ros_time_is_active:
            return None
        if self._due is None:
            return 0
        return max(0, self._due - int(self._clock.now().nanoseconds))
