"""When the next update is due, on ROS time.

With simulated time the clock's own messages give the ticks, since a timer on ROS time wakes the process once more
for each of them. Without, a timer does.
"""

from rclpy.node import Node

from bringup.filter.settings import NANOSECONDS


def next_tick(due: int, now: int, period: int) -> int:
    """Find the first tick after `now` in the rhythm of `due`; a clock that has gone back starts a new rhythm."""
    if now < due - period:
        return now + period
    return due + period * ((now - due) // period + 1)


class Ticks:
    """The ticks of one node, to be asked for after each callback of its executor."""

    def __init__(self, node: Node, frequency: float) -> None:
        self._node = node
        self._clock = node.get_clock()
        self._period = round(NANOSECONDS / frequency)
        self._timer = None
        self._timed_out = False
        self._due: int | None = None
        self._choose_source()

    def take(self) -> int | None:
        """Give the time (ns) if an update is due now, and each tick only once."""
        if self._clock.ros_time_is_active is (self._timer is not None):
            self._choose_source()
        now = int(self._clock.now().nanoseconds)
        return self._simulated_tick(now) if self._timer is None else self._timer_tick(now)

    def _timer_tick(self, now: int) -> int | None:
        due, self._timed_out = self._timed_out, False
        return now if due else None

    def _simulated_tick(self, now: int) -> int | None:
        if now == 0:  # No clock message has come.
            return None
        if self._due is not None and self._due - self._period <= now < self._due:
            return None
        self._due = next_tick(now if self._due is None else self._due, now, self._period)
        return now

    def _note(self) -> None:
        self._timed_out = True

    def _choose_source(self) -> None:
        self._due = None
        if self._timer is not None:
            self._node.destroy_timer(self._timer)
            self._timer = None
        if not self._clock.ros_time_is_active:
            self._timer = self._node.create_timer(self._period / NANOSECONDS, self._note)
