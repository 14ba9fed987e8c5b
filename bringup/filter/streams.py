"""One stream per part of a sensor's messages: how a message becomes something that can be measured."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TypeAlias

from bringup.filter import readings
from bringup.filter.estimator import Estimator
from bringup.filter.frames import FrameResolver
from bringup.filter.fusion import Fusion
from bringup.filter.measurement import Measurement
from bringup.filter.motion_parts import AccelerationMeasuring, TwistMeasuring
from bringup.filter.notices import Notices, check_orientation
from bringup.filter.pose_parts import OrientationMeasuring, PoseMeasuring, PoseTrack
from bringup.filter.rigid import IDENTITY, Transform
from bringup.filter.settings import Kind, Part, Sensor, Settings

FramePair: TypeAlias = tuple[str, str]


@dataclass(frozen=True, slots=True, eq=False)
class Surroundings:
    """What measurements depend on beside the messages."""

    settings: Settings
    estimator: Estimator
    fusion: Fusion
    frames: FrameResolver
    notices: Notices

    def between(self, pair: FramePair, stamp: int, part: str) -> Transform | None:
        """Find the transform to the first frame from the second; what cannot be found is noted."""
        target, source = pair
        key = f"{part}_transform_{source}"
        found = self.frames.between(target, source, stamp)
        if found is not None:
            self.notices.withdraw(key)
        else:
            text = f"{part}: no transform from {source} to {target}; the measurement is not used"
            self.notices.error(key, text)
        return found


@dataclass(frozen=True, slots=True, eq=False)
class Prepared:
    """A message part that has been read: the transforms it needs (target, source), and the step that is left."""

    stamp: int
    pairs: tuple[FramePair, ...]
    measure: Callable[[], Measurement | None]


@dataclass(slots=True, eq=False)
class Stream:
    """One part of a sensor; `newest` is the stamp (ns) of its last message."""

    name: str
    prepare: Callable[[readings.Message], Prepared | None]
    track: PoseTrack | None = None
    newest: int = 0


def streams_of(sensor: Sensor, around: Surroundings) -> list[Stream]:
    """List the streams of a sensor, in the order in which upstream takes its parts."""
    return _STREAMS[sensor.kind](sensor, around)


def _odometry(sensor: Sensor, around: Surroundings) -> list[Stream]:
    streams = []
    if sensor.pose is not None:
        streams.append(_pose_stream(sensor.pose, readings.odometry_pose, around))
    if sensor.twist is not None:
        streams.append(_twist_stream(sensor.twist, readings.odometry_twist, around))
    return streams


def _pose(sensor: Sensor, around: Surroundings) -> list[Stream]:
    return [] if sensor.pose is None else [_pose_stream(sensor.pose, readings.pose, around)]


def _twist(sensor: Sensor, around: Surroundings) -> list[Stream]:
    return [] if sensor.twist is None else [_twist_stream(sensor.twist, readings.twist, around)]


def _imu(sensor: Sensor, around: Surroundings) -> list[Stream]:
    streams = []
    if sensor.pose is not None:
        streams.append(_orientation_stream(sensor.pose, around))
    if sensor.twist is not None:
        streams.append(_twist_stream(sensor.twist, readings.imu_twist, around))
    if sensor.acceleration is not None:
        streams.append(
            _acceleration_stream(sensor.acceleration, around, remove_gravity=sensor.remove_gravity)
        )
    return streams


_STREAMS: dict[Kind, Callable[[Sensor, Surroundings], list[Stream]]] = {
    "odom": _odometry,
    "pose": _pose,
    "twist": _twist,
    "imu": _imu,
}


def _pose_stream(
    part: Part, read: Callable[[readings.Message], readings.PoseReading], around: Surroundings
) -> Stream:
    measuring = PoseMeasuring(part, two_d_mode=around.settings.estimation.two_d_mode)
    world, base = around.settings.frames.world, around.settings.frames.base_link

    def pairs(reading: readings.PoseReading) -> tuple[FramePair, ...]:
        # A difference between two poses holds in any frame.
        frame = (world, "" if part.differential else reading.frame)
        return (frame, (reading.child, base)) if part.use_child_frame and reading.child else (frame,)

    def measure(reading: readings.PoseReading) -> Measurement | None:
        check_orientation(reading.orientation, part.name, around.notices)
        found = [around.between(pair, reading.stamp, part.name) for pair in pairs(reading)]
        frame, to_base = found[0], found[-1] if len(found) > 1 else IDENTITY
        if frame is None or to_base is None:
            return None
        return measuring.measure(reading, frame, to_base)

    def prepare(message: readings.Message) -> Prepared:
        reading = read(message)
        return Prepared(reading.stamp, pairs(reading), partial(measure, reading))

    return Stream(part.name, prepare, measuring.track)


def _twist_stream(
    part: Part, read: Callable[[readings.Message], readings.TwistReading | None], around: Surroundings
) -> Stream:
    measuring = TwistMeasuring(part, two_d_mode=around.settings.estimation.two_d_mode)
    base = around.settings.frames.base_link

    def measure(reading: readings.TwistReading) -> Measurement | None:
        sensor = around.between((base, reading.frame), reading.stamp, part.name)
        return None if sensor is None else measuring.measure(reading, sensor, around.estimator.state)

    def prepare(message: readings.Message) -> Prepared | None:
        reading = read(message)
        if reading is None:
            return None
        return Prepared(reading.stamp, ((base, reading.frame),), partial(measure, reading))

    return Stream(part.name, prepare)


def _orientation_stream(part: Part, around: Surroundings) -> Stream:
    measuring = OrientationMeasuring(part, two_d_mode=around.settings.estimation.two_d_mode)
    base = around.settings.frames.base_link

    def measure(reading: readings.OrientationReading) -> Measurement | None:
        check_orientation(reading.orientation, part.name, around.notices)
        sensor = around.between((base, reading.frame), reading.stamp, part.name)
        return None if sensor is None else measuring.measure(reading, sensor)

    def prepare(message: readings.Message) -> Prepared | None:
        reading = readings.imu_orientation(message)
        if reading is None:
            return None
        return Prepared(reading.stamp, ((base, reading.frame),), partial(measure, reading))

    return Stream(part.name, prepare, measuring.track)


def _acceleration_stream(part: Part, around: Surroundings, *, remove_gravity: bool) -> Stream:
    estimation = around.settings.estimation
    gravity = estimation.gravity if remove_gravity else None
    measuring = AccelerationMeasuring(part, gravity, two_d_mode=estimation.two_d_mode)
    base = around.settings.frames.base_link

    def measure(reading: readings.AccelerationReading) -> Measurement | None:
        sensor = around.between((base, reading.frame), reading.stamp, part.name)
        if sensor is None:
            return None
        turning = around.fusion.angular_acceleration
        return measuring.measure(reading, sensor, around.estimator.state, turning)

    def prepare(message: readings.Message) -> Prepared | None:
        reading = readings.imu_acceleration(message)
        if reading is None:
            return None
        return Prepared(reading.stamp, ((base, reading.frame),), partial(measure, reading))

    return Stream(part.name, prepare)
