"""The periodic update: which waiting measurements are fused when, and when time passes without any."""

import heapq
import math
from collections.abc import Callable
from itertools import count
from typing import TypeAlias

import numpy as np

from bringup.filter.estimator import Estimator, Snapshot
from bringup.filter.history import History
from bringup.filter.joining import Joiner
from bringup.filter.measurement import Measurement
from bringup.filter.settings import NANOSECONDS, Timing
from bringup.filter.state import ANGULAR, Array

# Hears of each measurement, of the estimate after it, and whether the gate let it pass.
Trace: TypeAlias = Callable[[Measurement, Snapshot, bool], None]


class Fusion:
    """Queues measurements by their stamps and fuses those that are due at each update."""

    def __init__(self, estimator: Estimator, timing: Timing) -> None:
        self._estimator = estimator
        self._timing = timing
        self._queue: list[tuple[int, int, Measurement]] = []
        self._order = count()
        self._joiner = Joiner()
        self._history = History()
        self._updated: tuple[int, Array] | None = None
        self.angular_acceleration: Array = np.zeros(3)
        # The time in which the angular velocities were compared.
        self.seconds_between = math.inf
        self._rejected: list[str] = []
        self.trace: Trace | None = None

    def add(self, measurement: Measurement) -> None:
        """Put a measurement in the queue."""
        heapq.heappush(self._queue, (measurement.stamp, next(self._order), measurement))

    def clear(self) -> None:
        """Forget what waits and what is remembered."""
        self._queue.clear()
        self._history.clear()
        self._updated = None
        self.angular_acceleration = np.zeros(3)
        self.seconds_between = math.inf

    def skip(self, now: int) -> None:
        """Drop what waits and let the estimate stand as of `now` (ns), as if no time had passed."""
        self._queue.clear()
        self._history.clear()
        if self._estimator.initialised:
            self._estimator.stamp = max(now, self._estimator.stamp)

    def take_rejected(self) -> list[str]:
        """Name the parts whose measurements a gate has refused since the last call."""
        taken, self._rejected = self._rejected, []
        return taken

    def update(self, now: int) -> None:
        """Fuse every measurement that is due at `now` (ns), earliest first, and predict where none came.

        Measurements from the future stay in the queue, and as long as one is there no silence is assumed.
        """
        if self._queue:
            self._fuse_due(now)
        elif self._is_silent(now):
            self._estimator.predict_to(now)
        if self._timing.predict_to_current_time and self._estimator.initialised:
            self._estimator.predict_to(now)
        self._differentiate(now)
        if self._timing.smooth_lagged_data:
            self._history.forget(self._estimator.stamp - self._timing.history_length)

    def _is_silent(self, now: int) -> bool:
        estimator = self._estimator
        return estimator.initialised and now - estimator.stamp >= self._timing.sensor_timeout

    def _fuse_due(self, now: int) -> None:
        queue, estimator = self._queue, self._estimator
        command, commanded_at = estimator.command, estimator.commanded_at
        if self._timing.smooth_lagged_data:
            self._go_back()
        while queue and queue[0][0] <= now:
            measurement = heapq.heappop(queue)[2]
            if queue and queue[0][0] == measurement.stamp:
                measurement = self._of_one_moment(measurement)
            if measurement.command is not None:
                estimator.command, estimator.commanded_at = measurement.command, measurement.commanded_at
            accepted = estimator.process(measurement)
            if not accepted:
                self._rejected.append(measurement.part)
            if self.trace is not None:
                self.trace(measurement, estimator.snapshot(), accepted)
            if self._timing.smooth_lagged_data:
                self._remember(measurement)
        estimator.command, estimator.commanded_at = command, commanded_at

    def _of_one_moment(self, measurement: Measurement) -> Measurement:
        """Take the other measurements of the same stamp from the queue as well, if all of them can be joined.

        Who is told of each measurement gets each by itself, and the very first one is taken over alone.
        """
        estimator, queue = self._estimator, self._queue
        if self.trace is not None or estimator.observer is not None or not estimator.initialised:
            return measurement
        others = []
        while queue and queue[0][0] == measurement.stamp:
            others.append(heapq.heappop(queue))
        joined = self._joiner.join([measurement, *(other for _, _, other in others)])
        if len(joined) == 1:
            return joined[0]
        for other in others:
            heapq.heappush(queue, other)
        return measurement

    def _go_back(self) -> None:
        earliest = self._queue[0][0]
        if not self._estimator.initialised or earliest >= self._estimator.stamp:
            return
        past = self._history.go_back(earliest)
        if past is None:
            return
        snapshot, again = past
        self._estimator.restore(snapshot)
        for measurement in again:
            self.add(measurement)

    def _remember(self, measurement: Measurement) -> None:
        self._history.keep(measurement)
        if not self._queue or self._queue[0][0] != measurement.stamp:
            self._history.save(self._estimator.snapshot())

    def _differentiate(self, now: int) -> None:
        """Estimate the angular acceleration from two updates; without time between them the last one stays."""
        if not self._estimator.initialised:
            return
        omega = self._estimator.state[ANGULAR]
        if self._updated is not None and now > self._updated[0]:
            dt = (now - self._updated[0]) / NANOSECONDS
            self.angular_acceleration = (omega - self._updated[1]) / dt
            self.seconds_between = dt
        self._updated = now, omega
