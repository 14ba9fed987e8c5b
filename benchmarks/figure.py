"""What is measured: a figure, its bar, and the samples of its rounds."""

from __future__ import annotations

import math
import statistics
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Literal, Protocol, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Sequence

# How ours stands to the floor: so many times as much, so much more, growing with a power of the size; or by itself.
Way: TypeAlias = Literal["ratio", "difference", "exponent", "value"]


@dataclass(frozen=True, slots=True)
class Figure:
    """One line of the table. `bar` is the most that `way` may come to; `unit` is that of ours and of the floor.

    `size` is the one that the bar is about, `sizes` are those of the plot, `smallest` is for trying it out. `rounds`
    is how often it is measured where that takes long, None for as often as the others.
    """

    name: str
    title: str
    floor: str
    way: Way
    bar: float
    unit: str
    size: int
    sizes: tuple[int, ...]
    smallest: int
    rounds: int | None = None


@dataclass(frozen=True, slots=True)
class Sample:
    """One round: ours, the floor beside it where there is one, and ROS 2's own launch where it is installed."""

    ours: float
    floor: float | None = None
    peer: float | None = None


@dataclass(frozen=True, slots=True)
class Site:
    """Where it is measured: an empty folder for each round, and the environment of what is started."""

    folder: Path
    environment: Mapping[str, str]


class Measurement(Protocol):
    """What each module in `figures/` has: its figures, and what measures one round of all of them.

    `keys` of the result are names of figures. Raises `UnableError` where the machine lacks something.
    """

    FIGURES: tuple[Figure, ...]

    @staticmethod
    def measure(site: Site, size: int) -> Mapping[str, Sample]:
        """Measure ours and the floor once, one right after the other."""


class UnableError(Exception):
    """This machine cannot measure it; the message says what is missing."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """The medians of a figure at one size. `comes_to` is what the bar is held to."""

    figure: Figure
    size: int
    samples: tuple[Sample, ...]
    ours: float = field(init=False)
    floor: float | None = field(init=False)
    peer: float | None = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "ours", _median([sample.ours for sample in self.samples]))
        object.__setattr__(self, "floor", _median_of([sample.floor for sample in self.samples]))
        object.__setattr__(self, "peer", _median_of([sample.peer for sample in self.samples]))

    @property
    def comes_to(self) -> float:
        """How ours stands to the floor."""
        return _stands(self.figure.way, self.ours, self.floor)

    @property
    def peer_comes_to(self) -> float | None:
        """How ROS 2's own launch stands to the floor."""
        return None if self.peer is None else _stands(self.figure.way, self.peer, self.floor)

    @property
    def met(self) -> bool | None:
        """Whether it is within the bar; None for another size than that which the bar is about."""
        return self.comes_to <= self.figure.bar if self.size == self.figure.size else None


def _stands(way: Way, ours: float, floor: float | None) -> float:
    if way == "value" or floor is None:
        return ours
    if way == "difference":
        return ours - floor
    # What takes no time that can be seen takes at least a clock's tick.
    ratio = max(ours, 1e-9) / max(floor, 1e-9)
    return math.log10(ratio) if way == "exponent" else ratio


def _median(values: Sequence[float]) -> float:
    return statistics.median(values)


def _median_of(values: Sequence[float | None]) -> float | None:
    there = [value for value in values if value is not None]
    return _median(there) if there else None
