"""Publishes the filter's state of health on /diagnostics, about once a second."""

from collections import deque
from collections.abc import Iterable, Mapping

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.node import Node

from bringup.filter.checks import doubts
from bringup.filter.notices import Level
from bringup.filter.settings import NANOSECONDS, Settings
from bringup.filter_node.messages import Message, set_stamp

_QUEUE = 10
_WINDOW = 10
_ACCEPTED = 2.0
_TOLERANCE = 0.1
_GOOD = "settings and data are in order"
_BAD = "there are doubts about settings or data"


class Diagnostics:
    """Two statuses: what is wrong with settings and data, and how often `odometry/filtered` comes."""

    def __init__(self, node: Node, settings: Settings) -> None:
        self._name = node.get_name()
        self._frequency = settings.timing.frequency
        self._static = {key: (level, text) for level, key, text in doubts(settings)}
        self._publisher = node.create_publisher(DiagnosticArray, "/diagnostics", _QUEUE)
        self._counts: deque[tuple[int, int]] = deque(maxlen=_WINDOW)
        self._published = 0

    def count(self) -> None:
        """Note that an estimate has been published."""
        self._published += 1

    def report(self, now: int, notices: Mapping[str, tuple[Level, str]]) -> None:
        """Publish the settings' doubts, these notices and the rate up to now (ns)."""
        message = DiagnosticArray()
        set_stamp(message.header.stamp, now)
        message.status = [self._health({**self._static, **notices}), self._rate(now)]
        self._publisher.publish(message)

    def _health(self, found: Mapping[str, tuple[Level, str]]) -> Message:
        level = max((level for level, _ in found.values()), default=Level.OK)
        text = _GOOD if level is Level.OK else _BAD
        values = [(key, text) for key, (_, text) in found.items()]
        return self._status("Filter diagnostic updater", level, text, values)

    def _rate(self, now: int) -> Message:
        first = self._counts[0] if self._counts else (now, self._published)
        self._counts.append((now, self._published))
        seconds = (now - first[0]) / NANOSECONDS
        rate = (self._published - first[1]) / seconds if seconds > 0.0 else 0.0
        low, high = self._frequency - _ACCEPTED, self._frequency + _ACCEPTED
        good = low * (1.0 - _TOLERANCE) <= rate <= high * (1.0 + _TOLERANCE)
        values = [("Actual frequency (Hz)", f"{rate:f}"), ("Minimum acceptable frequency (Hz)", f"{low:f}")]
        values.append(("Maximum acceptable frequency (Hz)", f"{high:f}"))
        level, text = (Level.OK, "Desired frequency met") if good else (Level.WARN, "Frequency out of bounds")
        return self._status("odometry/filtered topic status", level, text, values)

    def _status(self, title: str, level: Level, text: str, values: Iterable[tuple[str, str]]) -> Message:
        status = DiagnosticStatus()
        status.name = f"{self._name}: {title}"
        status.level = bytes([level])
        status.message = text
        status.hardware_id = "none"
        status.values = [KeyValue(key=key, value=value) for key, value in values]
        return status
