"""Rigid transforms: where a source frame stands in a target frame."""

from dataclasses import dataclass

import numpy as np

from bringup.filter.rotation import Quaternion, matrix_from_quaternion
from bringup.filter.state import Array

_ROUNDING = 1e-12


@dataclass(frozen=True, slots=True, eq=False)
class Transform:
    """Takes a point of the source frame into the target frame: `rotation @ p + translation` (metres)."""

    rotation: Array
    translation: Array

    def __matmul__(self, other: "Transform") -> "Transform":
        return Transform(self.rotation @ other.rotation, self.rotation @ other.translation + self.translation)

    def inverse(self) -> "Transform":
        """Give the transform from the target frame back into the source frame."""
        back = self.rotation.T
        return Transform(back, -(back @ self.translation))

    def is_near(self, other: "Transform") -> bool:
        """Whether two transforms differ by no more than rounding."""
        return bool(
            np.abs(self.rotation - other.rotation).max() < _ROUNDING
            and np.abs(self.translation - other.translation).max() < _ROUNDING
        )


# One object, so that "nothing to do" is an identity check.
IDENTITY = Transform(np.eye(3), np.zeros(3))


def transform(translation: tuple[float, float, float], quaternion: Quaternion) -> Transform:
    """Build a transform from a translation and a quaternion (x, y, z, w)."""
    return Transform(matrix_from_quaternion(quaternion), np.array(translation))
