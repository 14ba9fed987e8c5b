"""The whole filter: messages and the passing of time go in, estimates come out."""

from dataclasses import dataclass

import numpy as np

from bringup.filter import readings
from bringup.filter.estimator import Estimator, Observer
from bringup.filter.frames import FrameResolver
from bringup.filter.fusion import Fusion, Trace
from bringup.filter.intake import ClockJumpError, Intake
from bringup.filter.notices import Notices
from bringup.filter.readings import Heard, Message
from bringup.filter.rigid import transform
from bringup.filter.rotation import rpy_from_matrix, six_dimensional
from bringup.filter.settings import Settings
from bringup.filter.start import doubt_about_origin
from bringup.filter.state import ANGULAR, POSE, Array
from bringup.filter.streams import Surroundings
from bringup.filter.transforms import TransformBuffer
from bringup.filter.variances import finite, judged, square


@dataclass(frozen=True, slots=True, eq=False)
class Estimate:
    """What the filter believes at `stamp` (ns): the 15 state variables, their covariance, and how omega changes.

    The change of omega is that between two updates, `compared_over` seconds apart.
    """

    stamp: int
    state: Array
    covariance: Array
    angular_acceleration: Array
    compared_over: float

    @property
    def angular_acceleration_covariance(self) -> Array:
        """That of the difference between two angular velocities, each with the present covariance."""
        spread: Array = self.covariance[ANGULAR, ANGULAR] * (2.0 / self.compared_over**2)
        return spread


class UnusablePoseError(Exception):
    """The robot cannot be put at a pose; the text says why."""


class Localization:
    """A filter with its sensors and frames. All times are nanoseconds of one clock.

    While it is not `enabled` it does nothing; while it is not `processing` it drops measurements and its estimate
    stands still.
    """

    def __init__(self, settings: Settings) -> None:
        self.notices = Notices()
        self.frames = FrameResolver(TransformBuffer())
        self.enabled = not settings.timing.disabled_at_startup
        self._timing = settings.timing
        self._world = settings.frames.world
        self._estimator = Estimator(settings.estimation, settings.control)
        self._fusion = Fusion(self._estimator, settings.timing)
        surroundings = Surroundings(settings, self._estimator, self._fusion, self.frames, self.notices)
        self.processing = True
        self._widening = tuple(sensor.name for sensor in settings.sensors if sensor.widens_start)
        self._to_widen = set(self._widening)
        self._kinds = {sensor.name: sensor.kind for sensor in settings.sensors}
        self._intake = Intake(settings.sensors, surroundings)
        self._corrections = settings.publication.corrections
        self._published: int | None = None
        self._updated: int | None = None

    def receive(self, sensor: str, message: Message, now: int) -> None:
        """Take in a message of the sensor with this name, such as `odom0`; a disabled filter takes none."""
        self.hear(sensor, readings.heard(self._kinds[sensor], message), now)

    def hear(self, sensor: str, said: Heard, now: int) -> None:
        """Take in what a message of a sensor says; a disabled filter takes nothing in."""
        if not self.enabled:
            return
        if sensor in self._to_widen:
            self._to_widen.remove(sensor)
            self._estimator.doubt_pose(doubt_about_origin(said))
        try:
            self._intake.receive(sensor, said, now)
        except ClockJumpError:
            self.reset()
            self.notices.warn("time_jump", f"the stamps of {sensor} jumped back: the filter starts afresh")
            self._intake.receive(sensor, said, now)

    def observe(self, observer: Observer) -> None:
        """Tell `observer` of each measurement that is about to be fused, with what was predicted for it."""
        self._estimator.observer = observer

    def trace(self, trace: Trace) -> None:
        """Tell `trace` of each measurement that has been fused or refused, with the estimate after it."""
        self._fusion.trace = trace

    def command(self, velocities: tuple[float, ...], stamp: int) -> None:
        """Note the velocities (vx vy vz vroll vpitch vyaw) that the robot is told to drive."""
        self._estimator.command = velocities
        self._estimator.commanded_at = stamp

    def update(self, now: int) -> None:
        """Fuse what is due; does nothing while disabled."""
        if not self.enabled:
            return
        jumped = self._updated is not None and now < self._updated
        if jumped and self._timing.reset_on_time_jump:
            self.reset()
            self.notices.warn("time_jump", "the clock jumped back: the filter starts afresh")
        self._updated = now
        if not self.processing:
            self._intake.drop()
            self._fusion.skip(now)
            return
        self._intake.release(now)
        self._fusion.update(now)
        for part in self._fusion.take_rejected():
            self.notices.warn(f"{part}_rejected", f"{part}: a measurement was beyond its rejection threshold")

    def estimate(self) -> Estimate | None:
        """Give the present estimate; None before the first measurement."""
        estimator, fusion = self._estimator, self._fusion
        if not estimator.initialised:
            return None
        return Estimate(
            estimator.stamp,
            estimator.state,
            estimator.covariance,
            fusion.angular_acceleration,
            fusion.seconds_between,
        )

    def estimate_to_publish(self) -> Estimate | None:
        """Give the present estimate if it is newer than the last one given here.

        With `permit_corrected_publication` one of the same or an earlier time is given as well.
        """
        estimate = self.estimate()
        if estimate is None or not self.enabled:
            return None
        if self._published is not None and estimate.stamp <= self._published and not self._corrections:
            return None
        self._published = estimate.stamp
        return estimate

    def set_pose(self, message: Message, now: int) -> None:
        """Put the robot at rest at a pose (geometry_msgs/PoseWithCovarianceStamped).

        Messages stamped up to the pose's own stamp are ignored from then on. Raises UnusablePoseError, and changes
        nothing, if the pose is not finite or cannot be taken into the world frame.
        """
        reading = readings.pose(readings.heard("pose", message))
        if not np.isfinite((*reading.position, *reading.orientation)).all():
            raise UnusablePoseError("the pose has numbers that are not finite")
        frame = self.frames.between(self._world, reading.frame, reading.stamp)
        if frame is None:
            raise UnusablePoseError(f"no transform from {reading.frame} to {self._world}")
        pose = frame @ transform(reading.position, reading.orientation)
        turn = six_dimensional(frame.rotation)
        vector = np.concatenate((pose.translation, rpy_from_matrix(pose.rotation)))
        covariance = judged(turn @ finite(square(reading.covariance)) @ turn.T, np.arange(POSE.stop)).matrix
        self._fusion.clear()
        self._intake.reset(ignored_up_to=reading.stamp)
        self._estimator.place(now, vector, covariance)
        self._to_widen.clear()
        self._published = None

    def reset(self) -> None:
        """Start afresh, as if nothing had been received; static transforms stay known."""
        self._estimator.reset()
        self._to_widen = set(self._widening)
        self._fusion.clear()
        self._intake.reset()
        self.frames.buffer.clear()
        self._published = None
        self._updated = None
