"""Takes messages in: which are accepted, which wait for their transform, what becomes of them."""

from collections import deque
from dataclasses import replace

from bringup.filter.measurement import Measurement
from bringup.filter.readings import Message, stamp_of
from bringup.filter.settings import NANOSECONDS
from bringup.filter.streams import Prepared, Stream, Surroundings, streams_of
from bringup.filter.variances import note_variances


class ClockJumpError(Exception):
    """A sensor's stamps went back in time while `reset_on_time_jump` is set."""


class Intake:
    """The streams of all sensors.

    A part of a message is ignored if its stamp is not later than the last set pose, or earlier than the stamp of
    the part before. Where `transform_timeout` is set, a message whose transform is not known at its stamp waits
    for it that long, and those after it with it; upstream blocks the whole filter instead.
    """

    def __init__(self, around: Surroundings) -> None:
        self._around = around
        self._streams = {sensor.name: streams_of(sensor, around) for sensor in around.settings.sensors}
        self._waiting: deque[tuple[int, Prepared]] = deque()
        self._timing = around.settings.timing
        self._checks_variances = around.settings.publication.diagnostics
        self._ignored_up_to = 0

    def reset(self, ignored_up_to: int = 0) -> None:
        """Forget all earlier messages, and ignore those stamped up to a time (ns)."""
        self._ignored_up_to = ignored_up_to
        self._waiting.clear()
        for stream in self._all():
            stream.newest = 0
            if stream.track is not None:
                stream.track.forget()

    def receive(self, sensor: str, message: Message, now: int) -> None:
        """Take in a message of a sensor at the time `now` (ns).

        Raises ClockJumpError if its stamp says that time has gone back and this is to be acted upon.
        """
        stamp = stamp_of(message)
        for stream in self._streams[sensor]:
            if not self._accepts(stream, stamp):
                continue
            prepared = stream.prepare(message)
            if prepared is None:
                continue
            if self._waiting or not self._is_ready(prepared):
                self._waiting.append((now + self._timing.transform_timeout, prepared))
            else:
                self._measure(prepared)

    def release(self, now: int) -> None:
        """Go on with messages whose transform has come, or whose time to wait for it is over."""
        while self._waiting:
            deadline, prepared = self._waiting[0]
            if now < deadline and not self._is_ready(prepared):
                return
            self._waiting.popleft()
            self._measure(prepared)

    def _all(self) -> list[Stream]:
        return [stream for streams in self._streams.values() for stream in streams]

    def _accepts(self, stream: Stream, stamp: int) -> bool:
        if stamp <= self._ignored_up_to:
            what = f"is not later than the last set pose at {self._ignored_up_to / NANOSECONDS:.9f} s"
        elif stamp < stream.newest:
            if self._timing.reset_on_time_jump:
                raise ClockJumpError
            what = f"is earlier than the message before it ({stream.newest / NANOSECONDS:.9f} s)"
        else:
            stream.newest = stamp
            return True
        text = f"{stream.name}: a message stamped {stamp / NANOSECONDS:.9f} s {what}; it is ignored"
        self._around.notices.warn(f"{stream.name}_timestamp", text)
        return False

    def _is_ready(self, prepared: Prepared) -> bool:
        if self._timing.transform_timeout <= 0:
            return True
        return all(self._around.frames.known_at(*pair, prepared.stamp) for pair in prepared.pairs)

    def _measure(self, prepared: Prepared) -> None:
        measurement = prepared.measure()
        if measurement is None:
            return
        if self._checks_variances:
            note_variances(measurement, self._around.notices)
        self._around.fusion.add(self._with_command(measurement))

    def _with_command(self, measurement: Measurement) -> Measurement:
        estimator = self._around.estimator
        if estimator.command is None:
            return measurement
        return replace(measurement, command=estimator.command, commanded_at=estimator.commanded_at)
