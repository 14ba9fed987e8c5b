"""Several readings of one moment as one measurement: parts of a message, and messages of several sensors.

Taking in independent readings of one moment together or one after the other gives the same estimate, and together
costs half as much. Parts with a rejection threshold are judged one by one and stay apart.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from bringup.filter.measurement import Measurement
from bringup.filter.settings import NEVER_REJECT
from bringup.filter.state import Array, Indices

# How many combinations are remembered; sensors whose covariances change with each message make new ones for ever.
_KEPT = 16


@dataclass(frozen=True, slots=True, eq=False)
class _Joint:
    """What becomes of parts with these covariances; `indices` is None where they have to stay apart."""

    noises: tuple[Array, ...]
    name: str
    indices: Indices | None
    noise: Array
    pinned: int


class Joiner:
    """Joins readings of one stamp; what hardly ever changes is worked out once."""

    def __init__(self) -> None:
        self._joints: dict[tuple[int, ...], _Joint] = {}

    def join(self, parts: Sequence[Measurement]) -> Sequence[Measurement]:
        """Give one measurement in place of several of one stamp, or these where they have to stay apart."""
        if len(parts) == 1:
            return parts
        for part in parts:
            if part.threshold < NEVER_REJECT:
                return parts
        joint = self._joint(parts)
        if joint.indices is None:
            return parts
        values: tuple[float, ...] = ()
        for part in parts:
            values += part.values[: -part.pinned] if part.pinned else part.values
        first = parts[0]
        return (
            Measurement(
                first.stamp,
                joint.name,
                joint.indices,
                values + (0.0,) * joint.pinned,
                joint.noise,
                NEVER_REJECT,
                joint.pinned,
                first.command,
                first.commanded_at,
            ),
        )

    def _joint(self, parts: Sequence[Measurement]) -> _Joint:
        # Covariances that have been looked at are kept, so that no other gets the identity of one.
        key = tuple([id(part.noise) for part in parts])
        joint = self._joints.get(key)
        if joint is None:
            if len(self._joints) >= _KEPT:
                self._joints.clear()
            joint = self._joints[key] = _worked_out(parts)
        return joint


def _worked_out(parts: Sequence[Measurement]) -> _Joint:
    """Put the covariances together; two parts that measure the same variable stay apart.

    What each part pins at zero is pinned once, with the variance that so many agreeing readings have.
    """
    noises = tuple(part.noise for part in parts)
    own = [part.indices[: len(part.indices) - part.pinned] for part in parts]
    pinned = parts[0].indices[len(own[0]) :]
    indices = np.concatenate((*own, pinned))
    name = "+".join(part.part for part in parts)
    if len(set(indices.tolist())) < len(indices):
        return _Joint(noises, name, None, np.zeros((0, 0)), 0)
    noise = np.zeros((len(indices), len(indices)))
    start = 0
    for part, variables in zip(parts, own, strict=True):
        end = start + len(variables)
        noise[start:end, start:end] = part.noise[: len(variables), : len(variables)]
        start = end
    rest = range(start, len(indices))
    weights = [
        1.0 / part.noise.diagonal()[len(variables) :] for part, variables in zip(parts, own, strict=True)
    ]
    noise[rest, rest] = 1.0 / np.sum(weights, axis=0)
    return _Joint(noises, name, indices, noise, len(pinned))
