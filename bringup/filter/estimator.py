"""The state estimate: how single measurements are taken in and how time passes between them."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from bringup.filter import kalman
from bringup.filter.control import controlled
from bringup.filter.measurement import Measurement
from bringup.filter.settings import NANOSECONDS, Control, Estimation
from bringup.filter.state import POSE, TWIST, Array, Indices

# Hears of a measurement before it corrects the estimate: the measurement, and state and covariance predicted for it.
Observer: TypeAlias = Callable[[Measurement, Array, Array], None]

_NO_COMMAND = (0.0,) * 6
_PLACED_VARIANCE = 1e-6
_LONGEST_STEP = 100_000 * NANOSECONDS
_STEP_OF_ANOTHER_CLOCK = NANOSECONDS // 100


@dataclass(frozen=True, slots=True, eq=False)
class Snapshot:
    """An estimate at one moment; arrays are never changed in place, so they can be kept."""

    stamp: int
    state: Array
    covariance: Array
    command: tuple[float, ...] | None = None
    commanded_at: int = 0


class Estimator:
    """State, covariance and the time (ns) they belong to.

    The estimator is not initialised before its first measurement, which it takes over as it is.
    """

    def __init__(self, estimation: Estimation, control: Control | None = None) -> None:
        self._estimation = estimation
        self._control = control
        self.observer: Observer | None = None
        self.reset()

    def reset(self) -> None:
        """Go back to the start: not initialised, with the configured initial state and covariance."""
        self.initialised = False
        self.stamp = 0
        self.state: Array = self._estimation.initial_state.copy()
        covariance = self._estimation.initial_covariance
        self.covariance: Array = (covariance + covariance.T) * 0.5
        self.command: tuple[float, ...] | None = None
        self.commanded_at = 0

    def snapshot(self) -> Snapshot:
        """Take down the present estimate."""
        return Snapshot(self.stamp, self.state, self.covariance, self.command, self.commanded_at)

    def restore(self, snapshot: Snapshot) -> None:
        """Go back to an earlier estimate."""
        self.stamp = snapshot.stamp
        self.state = snapshot.state
        self.covariance = snapshot.covariance
        self.command = snapshot.command
        self.commanded_at = snapshot.commanded_at

    def process(self, measurement: Measurement) -> bool:
        """Take in a measurement; tells whether the gate let it pass.

        A measurement older than the estimate is applied to the present state. Entries that are not finite are
        left out.
        """
        indices, values, noise = measurement.indices, measurement.values, measurement.noise
        # The sum is finite only if every entry is; one that overflows takes the longer way.
        if not math.isfinite(sum(values)):
            indices, values, noise = _finite(measurement)
        if not self.initialised:
            self._take_over(measurement.stamp, indices, values, noise)
            return True
        if measurement.stamp > self.stamp:
            self.predict_to(measurement.stamp)
            self.stamp = measurement.stamp
        if len(indices) == 0:
            return True
        if self.observer is not None:
            self.observer(measurement, self.state, self.covariance)
        corrected = kalman.correct(self.state, self.covariance, indices, values, noise, measurement.threshold)
        if corrected is None:
            return False
        self.state, self.covariance = corrected
        return True

    def predict_to(self, stamp: int) -> None:
        """Move the estimate on to a time; a time that has passed already changes nothing.

        A step of more than a day is another clock's time, not a robot's: the estimate moves on by 10 ms (upstream).
        """
        if stamp <= self.stamp:
            return
        if stamp - self.stamp > _LONGEST_STEP:
            stamp = self.stamp + _STEP_OF_ANOTHER_CLOCK
        dt = (stamp - self.stamp) / NANOSECONDS
        noise = self._process_noise()
        state = self._controlled(stamp, dt)
        self.state, self.covariance = kalman.predict(state, self.covariance, noise, dt)
        self.stamp = stamp

    def doubt_pose(self, covariance: Array) -> None:
        """Add to the covariance (6x6) of the pose."""
        self.covariance = self.covariance.copy()
        self.covariance[POSE, POSE] += covariance

    def place(self, stamp: int, pose: Array, covariance: Array) -> None:
        """Put the robot at rest at a pose (x y z roll pitch yaw) with a 6x6 covariance."""
        self.state = np.zeros_like(self.state)
        self.state[POSE] = pose
        self.covariance = np.eye(len(self.state)) * _PLACED_VARIANCE
        self.covariance[POSE, POSE] = covariance
        self.stamp = stamp

    def _take_over(self, stamp: int, indices: Indices, values: tuple[float, ...], noise: Array) -> None:
        self.state = self.state.copy()
        self.state[indices] = values
        self.covariance = self.covariance.copy()
        self.covariance[np.ix_(indices, indices)] = noise
        self.stamp = stamp
        self.initialised = True

    def _process_noise(self) -> Array:
        noise = self._estimation.process_noise
        if not self._estimation.dynamic_process_noise:
            return noise
        speed = self.state[TWIST]
        scaled = noise.copy()
        scaled[POSE, POSE] *= float(speed @ speed)
        return scaled

    def _controlled(self, stamp: int, dt: float) -> Array:
        """Give the state that the control acts upon; without a command in time the robot is taken to brake."""
        if self._control is None:
            return self.state
        command = self.command
        if command is None or stamp - self.commanded_at >= self._control.timeout:
            command = _NO_COMMAND
        return controlled(self.state, self._control, command, dt)


def _finite(measurement: Measurement) -> tuple[Indices, tuple[float, ...], Array]:
    finite = np.isfinite(measurement.values)
    values = tuple(value for value in measurement.values if math.isfinite(value))
    return measurement.indices[finite], values, measurement.noise[np.ix_(finite, finite)]
