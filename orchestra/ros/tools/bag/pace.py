"""When the messages of a bag are due. Pure; times of the recording in nanoseconds, those of now in seconds."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, TypeVar

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

_ItemT = TypeVar("_ItemT")

_NANOSECONDS: Final = 1e9


class Pace:
    """Recorded time as it goes on: at a rate, or not at all while it is paused."""

    def __init__(self, recorded: int, now: float, rate: float, *, paused: bool = False) -> None:
        self.rate = rate
        self.paused = paused
        self._recorded = recorded
        self._now = now

    def due(self, recorded: int) -> float | None:
        """Return when a recorded time is reached, None while it is paused."""
        if self.paused:
            return None
        return self._now + (recorded - self._recorded) / _NANOSECONDS / self.rate

    def at(self, now: float) -> int:
        """Return the recorded time."""
        gone = 0.0 if self.paused else (now - self._now) * self.rate * _NANOSECONDS
        return self._recorded + int(gone)

    def pause(self, now: float, *, paused: bool) -> None:
        """Stop here, or go on from here."""
        self._recorded, self._now = self.at(now), now
        self.paused = paused

    def step(self, recorded: int, now: float) -> None:
        """Be at a recorded time."""
        self._recorded, self._now = recorded, now

    def quicken(self, factor: float, now: float) -> None:
        """Change the rate from here on."""
        self._recorded, self._now = self.at(now), now
        self.rate *= factor


def with_ticks(
    messages: Iterable[tuple[int, _ItemT]], period: int | None
) -> Iterator[tuple[int, _ItemT | None]]:
    """Yield messages with their times, and between them None whenever the clock is to be told, each `period`."""
    due: int | None = None
    for recorded, item in messages:
        if period is not None:
            due = recorded if due is None else due
            while due <= recorded:
                yield due, None
                due += period
        yield recorded, item
