"""What follows from how a sensor is mounted, worked out once for as long as the mounting stays the same."""

import numpy as np

from bringup.filter.measurement import Measurement, Selection, select, turned
from bringup.filter.rigid import Transform
from bringup.filter.rotation import six_dimensional
from bringup.filter.settings import Flags, Part
from bringup.filter.state import Array
from bringup.filter.variances import Noise, finite, judged

_THREE_AXES = 3


class Mounting:
    """A part's flags and covariances seen from the frame that the filter works in.

    Most sensors send the same covariance for ever, so what has become of the last one is kept.
    """

    def __init__(self, part: Part, selection: Selection, rotation: Array | None, arm: Array | None) -> None:
        self._part = part
        self._selection = selection
        # Turns the part's vector; None where there is nothing to turn.
        self._rotation = rotation
        # From the base to the sensor (m); None where the sensor stands in the base's origin or measures no motion.
        self.arm = arm
        self._sent: bytes | None = None
        self._noise = Noise(np.zeros((0, 0)))

    @property
    def doubt(self) -> str:
        """What is doubtful about the covariance of the latest measurement."""
        return self._noise.doubt

    def turned(self, vector: Array) -> Array:
        """Turn a part's vector into the filter's axes."""
        return vector if self._rotation is None else self._rotation.dot(vector)

    def measurement(self, stamp: int, vector: Array, sent: Array) -> Measurement:
        """Select what is fused from a vector in the filter's axes and a covariance as the sensor sends it."""
        key = sent.tobytes()
        if key != self._sent:
            self._sent = key
            known = finite(sent)
            turned = known if self._rotation is None else self._rotation @ known @ self._rotation.T
            self._noise = self._judged(turned)
        return self._with(stamp, vector, self._noise)

    def turned_measurement(self, stamp: int, vector: Array, covariance: Array) -> Measurement:
        """Select what is fused from a vector and a covariance that are both in the filter's axes."""
        self._sent, self._noise = None, self._judged(finite(covariance))
        return self._with(stamp, vector, self._noise)

    def _judged(self, covariance: Array) -> Noise:
        return judged(self._selection.covariance(covariance), self._selection.indices)

    def _with(self, stamp: int, vector: Array, noise: Noise) -> Measurement:
        selection = self._selection
        return Measurement(
            stamp=stamp,
            part=self._part.name,
            indices=selection.indices,
            values=selection.values(vector),
            noise=noise.matrix,
            threshold=self._part.threshold,
            pinned=selection.pinned,
        )


class Mountings:
    """The mounting in force for one part; it is worked out again when the transform is another object.

    `flags` select from the part's vector, whose first entry is the state variable `offset`.
    """

    def __init__(self, part: Part, flags: Flags, offset: int, *, two_d_mode: bool) -> None:
        self._part = part
        self._flags = flags
        self._offset = offset
        self._two_d_mode = two_d_mode
        self._key: Transform | None = None
        self._mounting: Mounting | None = None

    @property
    def doubt(self) -> str:
        """What is doubtful about the covariance of the latest measurement."""
        return "" if self._mounting is None else self._mounting.doubt

    def of(self, frame: Transform, rotation: Array | None = None) -> Mounting:
        """Give the mounting for a transform; `rotation` replaces the transform's own."""
        if self._mounting is None or frame is not self._key:
            self._key = frame
            self._mounting = self._work_out(frame, frame.rotation if rotation is None else rotation)
        return self._mounting

    def _work_out(self, frame: Transform, rotation: Array) -> Mounting:
        flags = self._flags
        nothing_to_turn = np.array_equal(rotation, np.eye(_THREE_AXES))
        flagged = turned(flags, rotation)
        moves = any(flagged[:_THREE_AXES]) and bool(np.any(frame.translation))
        return Mounting(
            self._part,
            select(flagged, self._offset, two_d_mode=self._two_d_mode),
            None if nothing_to_turn else _widened(rotation, flags),
            frame.translation if moves else None,
        )


def _widened(rotation: Array, flags: Flags) -> Array:
    return rotation if len(flags) == _THREE_AXES else six_dimensional(rotation)
