"""One stream per part of a sensor's messages: how a message becomes something that can be measured."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, TypeAlias

from bringup.filter import readings
from bringup.filter.estimator import Estimator
from bringup.filter.frames import FrameResolver
from bringup.filter.fusion import Fusion
from bringup.filter.measurement import Measurement
from bringup.filter.motion_parts import AccelerationMeasuring, TurningMeasuring, TwistMeasuring
from bringup.filter.mounting import Mountings
from bringup.filter.notices import Notices, check_orientation
from bringup.filter.pose_parts import OrientationMeasuring, PoseMeasuring, PoseTrack
from bringup.filter.rigid import IDENTITY, Transform
from bringup.filter.settings import Kind, Part, Sensor, Settings

FramePair: TypeAlias = tuple[str, str]
# What a part has read in a message; each stream hands its own kind back to itself.
Reading: TypeAlias = Any


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
        found = self.frames.between(target, source, stamp)
        if found is None:
            text = f"{part}: no transform from {source} to {target}; the measurement is not used"
            self.notices.error(f"{part}_transform_{source}", text)
        elif self.notices:
            self.notices.withdraw(f"{part}_transform_{source}")
        return found


@dataclass(slots=True, eq=False)
class Stream:
    """One part of a sensor.

    `read` takes the part out of a message (None: the message has none); `pairs` names the transforms that it needs
    (target, source); `measure` does the rest. `newest` is the stamp (ns) of its last message.
    """

    name: str
    read: Callable[[readings.Heard], Reading]
    pairs: Callable[[Reading], tuple[FramePair, ...]]
    measure: Callable[[Reading], Measurement | None]
    mountings: Mountings
    track: PoseTrack | None = None
    newest: int = 0


def streams_of(sensor: Sensor, around: Surroundings) -> list[Stream]:
    """List the streams of a sensor, in the order in which upstream takes its parts."""
    return list(_STREAMS[sensor.kind](sensor, around))


def _odometry(sensor: Sensor, around: Surroundings) -> Iterator[Stream]:
    if sensor.pose is not None:
        yield _pose_stream(sensor.pose, readings.odometry_pose, around)
    if sensor.twist is not None:
        yield _twist_stream(sensor.twist, readings.odometry_twist, around)


def _pose(sensor: Sensor, around: Surroundings) -> Iterator[Stream]:
    if sensor.pose is not None:
        yield _pose_stream(sensor.pose, readings.pose, around)


def _twist(sensor: Sensor, around: Surroundings) -> Iterator[Stream]:
    if sensor.twist is not None:
        yield _twist_stream(sensor.twist, readings.twist, around)


def _imu(sensor: Sensor, around: Surroundings) -> Iterator[Stream]:
    if sensor.pose is not None:
        yield _orientation_stream(sensor.pose, around)
    if sensor.twist is not None:
        yield _turning_stream(sensor.twist, around)
    if sensor.acceleration is not None:
        yield _acceleration_stream(sensor.acceleration, around, remove_gravity=sensor.remove_gravity)


_STREAMS: dict[Kind, Callable[[Sensor, Surroundings], Iterator[Stream]]] = {
    "odom": _odometry,
    "pose": _pose,
    "twist": _twist,
    "imu": _imu,
}


def _pose_stream(
    part: Part, read: Callable[[readings.Heard], readings.PoseReading], around: Surroundings
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

    return Stream(part.name, read, pairs, measure, measuring.mountings, measuring.track)


def _twist_stream(
    part: Part, read: Callable[[readings.Heard], readings.TwistReading], around: Surroundings
) -> Stream:
    measuring = TwistMeasuring(part, two_d_mode=around.settings.estimation.two_d_mode)
    base = around.settings.frames.base_link

    def measure(reading: readings.TwistReading) -> Measurement | None:
        sensor = around.between((base, reading.frame), reading.stamp, part.name)
        return None if sensor is None else measuring.measure(reading, sensor, around.estimator.state)

    return Stream(part.name, read, _mounted_on(base), measure, measuring.mountings)


def _turning_stream(part: Part, around: Surroundings) -> Stream:
    measuring = TurningMeasuring(part, two_d_mode=around.settings.estimation.two_d_mode)
    base = around.settings.frames.base_link

    def measure(reading: readings.TurningReading) -> Measurement | None:
        sensor = around.between((base, reading.frame), reading.stamp, part.name)
        return None if sensor is None else measuring.measure(reading, sensor)

    return Stream(part.name, readings.imu_turning, _mounted_on(base), measure, measuring.mountings)


def _orientation_stream(part: Part, around: Surroundings) -> Stream:
    measuring = OrientationMeasuring(part, two_d_mode=around.settings.estimation.two_d_mode)
    base = around.settings.frames.base_link

    def measure(reading: readings.OrientationReading) -> Measurement | None:
        check_orientation(reading.orientation, part.name, around.notices)
        sensor = around.between((base, reading.frame), reading.stamp, part.name)
        return None if sensor is None else measuring.measure(reading, sensor)

    return Stream(
        part.name, readings.imu_orientation, _mounted_on(base), measure, measuring.mountings, measuring.track
    )


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

    return Stream(part.name, readings.imu_acceleration, _mounted_on(base), measure, measuring.mountings)


def _mounted_on(base: str) -> Callable[[Reading], tuple[FramePair, ...]]:
    return lambda reading: ((base, reading.frame),)
