"""Several parts of one message as one measurement.

Taking in independent readings of one moment together or one after the other gives the same estimate, and together
costs half as much. Parts with a rejection threshold are judged one by one and stay apart.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from bringup.filter.measurement import Measurement
from bringup.filter.settings import NEVER_REJECT
from bringup.filter.state import Array, Indices


@dataclass(frozen=True, slots=True, eq=False)
class _Joint:
    """What becomes of parts with these covariances."""

    noises: tuple[Array, ...]
    name: str
    indices: Indices
    noise: Array
    pinned: int


class Joiner:
    """Joins the parts of one sensor's messages; what hardly ever changes is worked out once."""

    def __init__(self) -> None:
        self._joint: _Joint | None = None

    def join(self, parts: Sequence[Measurement]) -> Sequence[Measurement]:
        """Give one measurement in place of several of one stamp, or these where they have to stay apart."""
        if len(parts) == 1 or any(part.threshold < NEVER_REJECT for part in parts):
            return parts
        joint = self._joint
        if joint is None or not _same(joint.noises, parts):
            joint = self._joint = _worked_out(parts)
        if joint is None:
            return parts
        values = np.concatenate([part.values[: len(part.values) - part.pinned] for part in parts])
        if joint.pinned:
            values = np.concatenate((values, np.zeros(joint.pinned)))
        stamp = parts[0].stamp
        return (
            Measurement(stamp, joint.name, joint.indices, values, joint.noise, NEVER_REJECT, joint.pinned),
        )


def _same(noises: tuple[Array, ...], parts: Sequence[Measurement]) -> bool:
    return len(noises) == len(parts) and all(
        noise is part.noise for noise, part in zip(noises, parts, strict=True)
    )


def _worked_out(parts: Sequence[Measurement]) -> _Joint | None:
    """Put the covariances together; None if two parts measure the same variable.

    What each part pins at zero is pinned once, with the variance that so many agreeing readings have.
    """
    own = [part.indices[: len(part.indices) - part.pinned] for part in parts]
    pinned = parts[0].indices[len(own[0]) :]
    indices = np.concatenate((*own, pinned))
    if len(set(indices.tolist())) < len(indices):
        return None
    noise = np.zeros((len(indices), len(indices)))
    start = 0
    for part, variables in zip(parts, own, strict=True):
        end = start + len(variables)
        noise[start:end, start:end] = part.noise[: len(variables), : len(variables)]
        start = end
    rest = range(start, len(indices))
    noise[rest, rest] = parts[0].noise.diagonal()[len(own[0]) :] / len(parts)
    name = "+".join(part.part for part in parts)
    return _Joint(tuple(part.noise for part in parts), name, indices, noise, len(pinned))
