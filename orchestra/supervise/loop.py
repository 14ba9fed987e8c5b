"""One thread, one epoll(7), one heap of timers: waits until something happens, and for nothing else.

`selectors` of the standard library makes a record of each descriptor and looks it up through two layers of mappings at
every event: for a thousand processes, with three descriptors each, that is a tenth of all that their lives cost.
"""

from __future__ import annotations

import heapq
import itertools
import select
import time
from collections.abc import Callable
from typing import TypeAlias

Callback: TypeAlias = Callable[[], object]

# The kernel takes no longer time than 2**31 ms (epoll_wait(2)): whoever waits longer looks at the clock once a day.
_LONGEST_WAIT = 86400.0

# With more timers than this, and than twice what was left the last time, those that were taken back are dropped.
_FEW_TIMERS = 256


class Timer:
    """A call that is due at a time; `cancel` takes it back."""

    __slots__ = ("_callback", "due")

    def __init__(self, due: float, callback: Callback) -> None:
        self.due = due
        self._callback: Callback | None = callback

    @property
    def cancelled(self) -> bool:
        """Whether it was taken back, or has been made."""
        return self._callback is None

    @property
    def name(self) -> str:
        """What is called, for people."""
        callback = getattr(self._callback, "func", self._callback)
        return getattr(callback, "__qualname__", repr(callback))

    def cancel(self) -> None:
        """Take the call back; harmless where it has been made."""
        self._callback = None

    def fire(self) -> None:
        """Make the call, once."""
        callback, self._callback = self._callback, None
        if callback:
            callback()


class Loop:
    """Calls back when a descriptor can be read or written, or when a time has come. `clock` is in seconds.

    `round` counts how often it has waited: what is asked of the kernel in a round covers all that the round tells of.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self.clock = clock
        self.round = 0
        self._epoll = select.epoll()
        self._watched: dict[int, Callback] = {}
        self._timers: list[tuple[float, int, Timer]] = []
        self._order = itertools.count()
        self._most_timers = _FEW_TIMERS

    def call_later(self, delay: float, callback: Callback) -> Timer:
        """Call once after `delay` seconds; with 0 in the next round, after what is ready now."""
        timer = Timer(self.clock() + delay, callback)
        heapq.heappush(self._timers, (timer.due, next(self._order), timer))
        if len(self._timers) > self._most_timers:
            self._drop_cancelled()
        return timer

    def on_readable(self, descriptor: int, callback: Callback) -> None:
        """Call whenever the descriptor can be read."""
        self._epoll.register(descriptor, select.EPOLLIN)
        self._watched[descriptor] = callback

    def on_writable(self, descriptor: int, callback: Callback) -> None:
        """Call whenever the descriptor can be written."""
        self._epoll.register(descriptor, select.EPOLLOUT)
        self._watched[descriptor] = callback

    def forget(self, descriptor: int) -> None:
        """Call no more for this descriptor; do it before the descriptor is closed."""
        del self._watched[descriptor]
        self._epoll.unregister(descriptor)

    def pending(self) -> list[tuple[float, str]]:
        """Return in how many seconds each timer is due, and what it calls; for people."""
        now = self.clock()
        waiting = sorted((due, order, timer) for due, order, timer in self._timers if not timer.cancelled)
        return [(due - now, timer.name) for due, _, timer in waiting]

    def run_once(self) -> None:
        """Wait for the next thing to happen and make its calls."""
        timeout = self._until_next_timer()
        ready = self._epoll.poll(timeout, len(self._watched) or 1)
        self.round += 1
        for descriptor, callback in [(number, self._watched[number]) for number, _ in ready]:
            # An earlier call of this round may have forgotten a later descriptor, and opened the number anew.
            if self._watched.get(descriptor) is callback:
                callback()
        self._fire(self.clock())

    def close(self) -> None:
        """Give the epoll back."""
        self._epoll.close()

    def _drop_cancelled(self) -> None:
        """Keep what is still to come: a process that restarts all day takes back a timer of a minute each time."""
        self._timers = [entry for entry in self._timers if not entry[2].cancelled]
        heapq.heapify(self._timers)
        self._most_timers = max(_FEW_TIMERS, 2 * len(self._timers))

    def _until_next_timer(self) -> float | None:
        while self._timers and self._timers[0][2].cancelled:
            heapq.heappop(self._timers)
        if not self._timers:
            return None
        return min(max(0.0, self._timers[0][0] - self.clock()), _LONGEST_WAIT)

    def _fire(self, now: float) -> None:
        due: list[Timer] = []
        while self._timers and self._timers[0][0] <= now:
            due.append(heapq.heappop(self._timers)[2])
        for timer in due:
            timer.fire()
