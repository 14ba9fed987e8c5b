"""What times, sizes and ages of messages say: pure functions over a window of them."""

from __future__ import annotations

from collections import deque
from math import fsum, sqrt
from typing import Any

from orchestra.dataclass import dataclass

_KILO, _MEGA = 1000, 1_000_000


@dataclass(frozen=True, slots=True)
class Summary:
    """The mean, the extremes and the standard deviation of the last `count` values."""

    mean: float
    least: float
    most: float
    deviation: float
    count: int


class Window:
    """The last values of a row, at most `length` of them."""

    def __init__(self, length: int) -> None:
        self.values: deque[float] = deque(maxlen=length)
        self.heard = 0

    def add(self, value: float) -> None:
        """Take one more."""
        self.values.append(value)
        self.heard += 1

    def summary(self) -> Summary | None:
        """Return what they say, None where there are none."""
        if not self.values:
            return None
        count = len(self.values)
        mean = fsum(self.values) / count
        deviation = sqrt(fsum((value - mean) ** 2 for value in self.values) / count)
        return Summary(mean, min(self.values), max(self.values), deviation, count)


class Intervals(Window):
    """The times between messages, in seconds; a time that jumps back begins anew."""

    _last: float | None = None

    def hear(self, when: float) -> None:
        """Take the time of one more message."""
        if self._last is not None and when < self._last:
            self.values.clear()
        elif self._last is not None:
            self.add(when - self._last)
        self._last = when


def rate_text(summary: Summary) -> str:
    """Return the rate that the times between messages make, as `ros2 topic hz` writes it."""
    rate = 1 / summary.mean if summary.mean > 0 else 0.0
    return f"average rate: {rate:.3f}\n{_spread(summary)}"


def delay_text(summary: Summary) -> str:
    """Return the ages of messages, as `ros2 topic delay` writes them."""
    return f"average delay: {summary.mean:.3f}\n{_spread(summary)}"


def rate_data(summary: Summary) -> dict[str, Any]:
    """Return the same as data."""
    return {"rate": 1 / summary.mean if summary.mean > 0 else 0.0, **_spread_data(summary)}


def delay_data(summary: Summary) -> dict[str, Any]:
    """Return the same as data."""
    return {"delay": summary.mean, **_spread_data(summary)}


def bandwidth_text(sizes: Summary, seconds: float) -> str:
    """Return how much comes in, as `ros2 topic bw` writes it."""
    per_second = sizes.mean * sizes.count / seconds
    scale, unit = (1, "B") if per_second < _KILO else (_KILO, "KB") if per_second < _MEGA else (_MEGA, "MB")
    amounts = [per_second, sizes.mean, sizes.least, sizes.most]
    digits = 0 if scale == 1 else 2
    total, mean, least, most = (f"{amount / scale:.{digits}f} {unit}" for amount in amounts)
    return f"{total}/s from {sizes.count} messages\n\tMessage size mean: {mean} min: {least} max: {most}\n"


def bandwidth_data(sizes: Summary, seconds: float) -> dict[str, Any]:
    """Return the same as data: bytes, and bytes per second."""
    return {
        "bandwidth": sizes.mean * sizes.count / seconds,
        "messages": sizes.count,
        "mean": sizes.mean,
        "min": sizes.least,
        "max": sizes.most,
    }


def _spread(summary: Summary) -> str:
    return (
        f"\tmin: {summary.least:.3f}s max: {summary.most:.3f}s "
        f"std dev: {summary.deviation:.5f}s window: {summary.count}\n"
    )


def _spread_data(summary: Summary) -> dict[str, Any]:
    return {
        "min": summary.least,
        "max": summary.most,
        "std_dev": summary.deviation,
        "window": summary.count,
    }
