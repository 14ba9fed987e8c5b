"""Transforms between frames as they are heard on /tf and /tf_static, and their values at a given time."""

from bisect import bisect_left
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, field

from bringup.filter.rigid import IDENTITY, Transform, transform
from bringup.filter.rotation import Quaternion, interpolate
from bringup.filter.settings import NANOSECONDS

_KEPT = 10 * NANOSECONDS


class TransformUnavailableError(Exception):
    """No transform is known between two frames at the time asked for."""


@dataclass(frozen=True, slots=True)
class Sample:
    """Where a child frame stands in its parent frame at `stamp` (ns)."""

    stamp: int
    translation: tuple[float, float, float]
    rotation: Quaternion

    def transform(self) -> Transform:
        """Give the sample as a transform from child to parent."""
        return transform(self.translation, self.rotation)


@dataclass(slots=True)
class _Edge:
    parent: str
    static: Transform | None = None
    samples: deque[Sample] = field(default_factory=deque)

    def at(self, stamp: int | None) -> Transform:
        if self.static is not None:
            return self.static
        if stamp is None:
            return self.samples[-1].transform()
        place = bisect_left(self.samples, stamp, key=lambda sample: sample.stamp)
        if place < len(self.samples) and self.samples[place].stamp == stamp:
            return self.samples[place].transform()
        if place in {0, len(self.samples)}:
            raise TransformUnavailableError(
                f"{self.parent} is not known at {stamp}: this would be extrapolation"
            )
        return _between(self.samples[place - 1], self.samples[place], stamp)


def _between(before: Sample, after: Sample, stamp: int) -> Transform:
    fraction = (stamp - before.stamp) / (after.stamp - before.stamp)
    x, y, z = (a + (b - a) * fraction for a, b in zip(before.translation, after.translation, strict=True))
    return transform((x, y, z), interpolate(before.rotation, after.rotation, fraction))


class TransformBuffer:
    """A forest of frames: each child has one parent, static or with ten seconds of samples."""

    def __init__(self) -> None:
        self._edges: dict[str, _Edge] = {}

    def clear(self) -> None:
        """Forget everything that moves; static transforms are sent once and stay."""
        for child in [child for child, edge in self._edges.items() if edge.static is None]:
            del self._edges[child]

    def set_static(self, parent: str, child: str, sample: Sample) -> None:
        """Note a transform that holds at all times."""
        self._edges[child] = _Edge(parent, static=sample.transform())

    def add(self, parent: str, child: str, sample: Sample) -> None:
        """Note where a child is at one time; samples that come late are put in their place."""
        edge = self._edges.get(child)
        if edge is None or edge.static is not None or edge.parent != parent:
            edge = self._edges[child] = _Edge(parent)
        samples = edge.samples
        if not samples or sample.stamp > samples[-1].stamp:
            samples.append(sample)
        else:
            place = bisect_left(samples, sample.stamp, key=lambda kept: kept.stamp)
            samples.insert(place, sample)
        while samples[0].stamp < samples[-1].stamp - _KEPT:
            samples.popleft()

    def is_static(self, target: str, source: str) -> bool:
        """Whether two frames are joined by static transforms alone."""
        up, down = self._paths(target, source)
        return all(self._edges[child].static is not None for child in (*up, *down))

    def lookup(self, target: str, source: str, stamp: int | None = None) -> Transform:
        """Find the transform that takes source coordinates to target coordinates.

        At `stamp` (ns), between samples by interpolation; without a stamp, at the newest time that all frames on
        the way have. Raises TransformUnavailableError.
        """
        up, down = self._paths(target, source)
        if stamp is None:
            stamp = self._newest_common((*up, *down))
        return self._chain(down, stamp).inverse() @ self._chain(up, stamp)

    def _chain(self, children: list[str], stamp: int | None) -> Transform:
        """Take coordinates of the first child up to the parent of the last."""
        result = IDENTITY
        for child in children:
            result = self._edges[child].at(stamp) @ result
        return result

    def _newest_common(self, children: tuple[str, ...]) -> int | None:
        newest = [edge.samples[-1].stamp for child in children if (edge := self._edges[child]).static is None]
        return min(newest, default=None)

    def _paths(self, target: str, source: str) -> tuple[list[str], list[str]]:
        """List the children on the ways from source and from target up to the frame that both stand in."""
        up, down = list(self._ancestry(source)), list(self._ancestry(target))
        if up[-1] != down[-1]:
            raise TransformUnavailableError(f"{target} and {source} are not connected")
        while up and down and up[-1] == down[-1]:
            up.pop()
            down.pop()
        return up, down

    def _ancestry(self, frame: str) -> Iterator[str]:
        seen: set[str] = set()
        while frame not in seen:
            seen.add(frame)
            yield frame
            edge = self._edges.get(frame)
            if edge is None:
                return
            frame = edge.parent
