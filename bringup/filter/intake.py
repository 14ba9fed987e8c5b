"""Takes messages in: which are accepted, which wait for their transform, what becomes of them."""

from collections import deque
from dataclasses import dataclass, field

from bringup.filter.joining import Joiner
from bringup.filter.measurement import Measurement
from bringup.filter.readings import Heard
from bringup.filter.settings import NANOSECONDS, Sensor
from bringup.filter.streams import Reading, Stream, Surroundings, streams_of

# Messages that are no more out of order than this come from several publishers, not from another time.
_DISORDER = NANOSECONDS


class ClockJumpError(Exception):
    """A sensor's stamps went back in time by more than a second while `reset_on_time_jump` is set."""


@dataclass(frozen=True, slots=True, eq=False)
class _Source:
    """A sensor's streams, and what joins the parts of its messages."""

    streams: list[Stream]
    joiner: Joiner = field(default_factory=Joiner)


class Intake:
    """The streams of all sensors.

    A part of a message is ignored if its stamp is not later than the last set pose, or earlier than the stamp of
    the part before. Where `transform_timeout` is set, a message whose transform is not known at its stamp waits
    for it that long, and those after it with it; upstream blocks the whole filter instead.
    """

    def __init__(self, sensors: tuple[Sensor, ...], around: Surroundings) -> None:
        self._around = around
        self._sources = {sensor.name: _Source(streams_of(sensor, around)) for sensor in sensors}
        self._waiting: deque[tuple[int, Stream, Reading]] = deque()
        self._timing = around.settings.timing
        self._tells_doubts = around.settings.publication.diagnostics
        self._ignored_up_to = 0

    def reset(self, ignored_up_to: int = 0) -> None:
        """Forget all earlier messages, and ignore those stamped up to a time (ns)."""
        self._ignored_up_to = ignored_up_to
        self._waiting.clear()
        for source in self._sources.values():
            for stream in source.streams:
                stream.newest = 0
                if stream.track is not None:
                    stream.track.forget()

    def receive(self, sensor: str, said: Heard, now: int) -> None:
        """Take in a message of a sensor at the time `now` (ns).

        Raises ClockJumpError if its stamp says that time has gone back and this is to be acted upon.
        """
        source = self._sources[sensor]
        measured = []
        for stream in source.streams:
            if not self._accepts(stream, said.stamp):
                continue
            reading = stream.read(said)
            if reading is None:
                continue
            if self._waiting or not self._is_ready(stream, reading):
                self._waiting.append((now + self._timing.transform_timeout, stream, reading))
                continue
            measurement = self._measure(stream, reading)
            if measurement is not None:
                measured.append(measurement)
        if measured:
            for measurement in source.joiner.join(measured):
                self._around.fusion.add(self._with_command(measurement))

    def release(self, now: int) -> None:
        """Go on with messages whose transform has come, or whose time to wait for it is over."""
        while self._waiting:
            deadline, stream, reading = self._waiting[0]
            if now < deadline and not self._is_ready(stream, reading):
                return
            self._waiting.popleft()
            measurement = self._measure(stream, reading)
            if measurement is not None:
                self._around.fusion.add(self._with_command(measurement))

    def drop(self) -> None:
        """Forget the messages that wait for their transforms."""
        self._waiting.clear()

    def _accepts(self, stream: Stream, stamp: int) -> bool:
        if stamp <= self._ignored_up_to:
            what = f"is not later than the last set pose at {self._ignored_up_to / NANOSECONDS:.9f} s"
        elif stamp < stream.newest:
            if self._timing.reset_on_time_jump and stamp < stream.newest - _DISORDER:
                raise ClockJumpError
            what = f"is earlier than the message before it ({stream.newest / NANOSECONDS:.9f} s)"
        else:
            stream.newest = stamp
            return True
        text = f"{stream.name}: a message stamped {stamp / NANOSECONDS:.9f} s {what}; it is ignored"
        self._around.notices.warn(f"{stream.name}_timestamp", text)
        return False

    def _is_ready(self, stream: Stream, reading: Reading) -> bool:
        if self._timing.transform_timeout <= 0:
            return True
        frames = self._around.frames
        return all(frames.known_at(*pair, reading.stamp) for pair in stream.pairs(reading))

    def _measure(self, stream: Stream, reading: Reading) -> Measurement | None:
        measurement = stream.measure(reading)
        if measurement is not None and self._tells_doubts and stream.mountings.doubt:
            text = f"{stream.name}: {stream.mountings.doubt}"
            self._around.notices.warn(f"{stream.name}_covariance", text)
        return measurement

    def _with_command(self, measurement: Measurement) -> Measurement:
        estimator = self._around.estimator
        if estimator.command is None:
            return measurement
        return measurement._replace(command=estimator.command, commanded_at=estimator.commanded_at)
