"""What follows from how a sensor is mounted, worked out once for as long as the mounting stays the same."""

import numpy as np

from bringup.filter.measurement import Measurement, Selection, select, turned
from bringup.filter.rigid import Transform
from bringup.filter.rotation import Rows, Vector, product, rows_of, six_dimensional, vector
from bringup.filter.settings import Flags, Part
from bringup.filter.state import Array
from bringup.filter.variances import Noise, finite, judged, square

_THREE_AXES = 3


class Mounting:
    """A part's flags and covariances seen from the frame that the filter works in.

    Most sensors send the same covariance for ever, so what has become of the last one is kept.
    """

    def __init__(self, part: Part, selection: Selection, rotation: Array | None, arm: Vector | None) -> None:
        self._part = part
        self._selection = selection
        # Turns three axes at a time; None where there is nothing to turn.
        self._rotation = rotation
        self._rows: Rows | None = None if rotation is None else rows_of(rotation)
        # From the base to the sensor (m); None where the sensor stands in the base's origin or measures no motion.
        self.arm = arm
        self._sent: tuple[float, ...] | None = None
        self._noise = Noise(np.zeros((0, 0)))

    @property
    def doubt(self) -> str:
        """What is doubtful about the covariance of the latest measurement."""
        return self._noise.doubt

    def turned(self, vector: Vector) -> Vector:
        """Turn a vector into the filter's axes."""
        return vector if self._rows is None else product(self._rows, vector)

    def measurement(self, stamp: int, values: tuple[float, ...], sent: tuple[float, ...]) -> Measurement:
        """Select what is fused from values in the filter's axes and a covariance as the sensor sends it."""
        if sent != self._sent:
            self._sent = sent
            self._noise = self._judged(self._turned_covariance(finite(square(sent))))
        return self._with(stamp, values)

    def turned_measurement(self, stamp: int, values: tuple[float, ...], covariance: Array) -> Measurement:
        """Select what is fused from values and a covariance that are both in the filter's axes."""
        self._sent, self._noise = None, self._judged(finite(covariance))
        return self._with(stamp, values)

    def _turned_covariance(self, covariance: Array) -> Array:
        if self._rotation is None:
            return covariance
        turn = self._rotation if len(covariance) == _THREE_AXES else six_dimensional(self._rotation)
        return turn @ covariance @ turn.T

    def _judged(self, covariance: Array) -> Noise:
        return judged(self._selection.covariance(covariance), self._selection.indices)

    def _with(self, stamp: int, values: tuple[float, ...]) -> Measurement:
        part, selection = self._part, self._selection
        return Measurement(
            stamp,
            part.name,
            selection.indices,
            selection.values(values),
            self._noise.matrix,
            part.threshold,
            selection.pinned,
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
            None if nothing_to_turn else rotation,
            vector(frame.translation.tolist()) if moves else None,
        )
