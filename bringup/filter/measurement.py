"""Measurements of state variables, and how a part's flags select them once the sensor's mounting is known."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from bringup.filter.settings import Flags
from bringup.filter.state import OUT_OF_PLANE, Array, Indices

# A turned flag counts from this share of an axis on.
_NO_SHARE = 1e-6
_PINNED_VARIANCE = 1e-6


class Measurement(NamedTuple):
    """Direct readings of the state variables `indices`, taken at `stamp` (ns).

    A tuple because one is made for each part of each message, and a frozen dataclass takes five times as long to make.
    `noise` is a covariance that can be used as it is. The last `pinned` entries are not measured but held at zero
    by `two_d_mode`. `command` is the velocity command that was in force when the reading came in, if there was one.
    """

    stamp: int
    part: str
    indices: Indices
    values: tuple[float, ...]
    noise: Array
    threshold: float
    pinned: int = 0
    command: tuple[float, ...] | None = None
    commanded_at: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class Selection:
    """Which entries of a part's own vector are fused, and as which state variables.

    With `two_d_mode` the variables that leave the plane follow, as zeros with a variance of 1e-6 that are
    independent of what is measured (upstream leaves the message's correlations in place, which can make the
    covariance indefinite).
    """

    indices: Indices
    entries: tuple[int, ...]
    source: Indices
    target: Indices
    noise: Array
    pinned: int

    def values(self, vector: tuple[float, ...]) -> tuple[float, ...]:
        """Select from the part's vector."""
        if len(self.entries) == len(vector):
            return vector + (0.0,) * self.pinned
        return *[vector[entry] for entry in self.entries], *(0.0,) * self.pinned

    def covariance(self, covariance: Array) -> Array:
        """Select from the part's covariance."""
        chosen = self.noise.copy()
        chosen.put(self.target, covariance.take(self.source))
        return chosen


def select(flags: Flags, offset: int, *, two_d_mode: bool) -> Selection:
    """Select the flagged entries of a part whose vector starts at state variable `offset`."""
    flagged = [entry for entry, on in enumerate(flags) if on]
    pinned = OUT_OF_PLANE if two_d_mode else ()
    entries = [entry for entry in flagged if entry + offset not in pinned]
    indices = [entry + offset for entry in entries] + list(pinned)
    size, count = len(indices), len(entries)
    width = len(flags)
    noise = np.zeros((size, size))
    noise[range(count, size), range(count, size)] = _PINNED_VARIANCE
    return Selection(
        indices=np.array(indices, dtype=np.intp),
        entries=tuple(entries),
        source=np.array([row * width + column for row in entries for column in entries], dtype=np.intp),
        target=np.array(
            [row * size + column for row in range(count) for column in range(count)], dtype=np.intp
        ),
        noise=noise,
        pinned=len(pinned),
    )


def turned(flags: Flags, rotation: Array) -> Flags:
    """Tell which axes see anything of the flagged ones after a rotation; three axes at a time."""
    return tuple(
        bool(np.linalg.norm(row * flags[start : start + 3]) >= _NO_SHARE)
        for start in range(0, len(flags), 3)
        for row in rotation
    )
