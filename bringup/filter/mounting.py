"""What follows from how a sensor is mounted, worked out once for as long as the mounting stays the same."""

from dataclasses import dataclass

import numpy as np

from bringup.filter.measurement import Measurement, Selection, select, turned
from bringup.filter.rigid import Transform
from bringup.filter.rotation import six_dimensional
from bringup.filter.settings import Flags, Part
from bringup.filter.state import Array

_THREE_AXES = 3


@dataclass(frozen=True, slots=True, eq=False)
class Mounting:
    """A part's flags and covariances seen from the frame that the filter works in."""

    part: Part
    selection: Selection
    # Turns the part's vector; None where there is nothing to turn.
    rotation: Array | None
    moves: bool

    def turned(self, vector: Array) -> Array:
        """Turn a part's vector into the filter's axes."""
        return vector if self.rotation is None else self.rotation @ vector

    def turned_covariance(self, covariance: Array) -> Array:
        """Turn a part's covariance into the filter's axes."""
        return covariance if self.rotation is None else self.rotation @ covariance @ self.rotation.T

    def measurement(self, stamp: int, vector: Array, covariance: Array) -> Measurement:
        """Select what is fused from a vector and a covariance in the filter's axes."""
        return Measurement(
            stamp=stamp,
            part=self.part.name,
            indices=self.selection.indices,
            values=self.selection.values(vector),
            noise=self.selection.covariance(covariance),
            threshold=self.part.threshold,
        )


class Mountings:
    """The mounting in force for one part; it is worked out again when the transform is another object."""

    def __init__(self, part: Part, offset: int, *, two_d_mode: bool) -> None:
        self._part = part
        self._offset = offset
        self._two_d_mode = two_d_mode
        self._key: Transform | None = None
        self._mounting: Mounting | None = None

    def of(self, frame: Transform, rotation: Array | None = None) -> Mounting:
        """Give the mounting for a transform; `rotation` replaces the transform's own."""
        if self._mounting is None or frame is not self._key:
            self._key = frame
            self._mounting = self._work_out(frame, frame.rotation if rotation is None else rotation)
        return self._mounting

    def _work_out(self, frame: Transform, rotation: Array) -> Mounting:
        flags = self._part.flags
        nothing_to_turn = np.array_equal(rotation, np.eye(_THREE_AXES))
        return Mounting(
            part=self._part,
            selection=select(turned(flags, rotation), self._offset, two_d_mode=self._two_d_mode),
            rotation=None if nothing_to_turn else _widened(rotation, flags),
            moves=any(turned(flags, rotation)[:_THREE_AXES]) and bool(np.any(frame.translation)),
        )


def _widened(rotation: Array, flags: Flags) -> Array:
    return rotation if len(flags) == _THREE_AXES else six_dimensional(rotation)
