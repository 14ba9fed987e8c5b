"""Where a sensor's frame stands for a measurement: at its stamp, else at the newest time, else not at all."""

from bringup.filter.rigid import IDENTITY, Transform
from bringup.filter.transforms import Sample, TransformBuffer, TransformUnavailableError


class FrameResolver:
    """Looks transforms up as robot_localization does, and remembers those that cannot change."""

    def __init__(self, buffer: TransformBuffer) -> None:
        self._buffer = buffer
        self._fixed: dict[tuple[str, str], Transform] = {}
        self._asked: set[tuple[str, str]] = set()
        # What moves by its publisher's account and yet stands still is the same object each time.
        self._latest: dict[tuple[str, str], Transform] = {}

    @property
    def buffer(self) -> TransformBuffer:
        """The transforms that are known."""
        return self._buffer

    def add_static(self, parent: str, child: str, sample: Sample) -> None:
        """Note a transform that holds at all times, and look up anew what may depend on it."""
        self._buffer.set_static(parent, child, sample)
        self._asked.update(self._fixed)
        self._fixed.clear()

    def between(self, target: str, source: str, stamp: int) -> Transform | None:
        """Find the transform from source to target for a measurement of `stamp` (ns).

        An empty source is the target itself. None means that the frames are not connected.
        """
        if not source or source == target:
            return IDENTITY
        fixed = self._fixed.get((target, source))
        return fixed if fixed is not None else self._looked_up(target, source, stamp)

    def needs_moving_transforms(self) -> bool:
        """Whether any lookup so far found no way over static transforms alone."""
        return bool(self._asked)

    def known_at(self, target: str, source: str, stamp: int) -> bool:
        """Whether the transform at exactly this time is known, or need not be."""
        if source in {target, ""} or (target, source) in self._fixed:
            return True
        try:
            self._buffer.lookup(target, source, stamp)
        except TransformUnavailableError:
            return False
        return True

    def _looked_up(self, target: str, source: str, stamp: int) -> Transform | None:
        for time in (stamp, None):
            try:
                found = self._buffer.lookup(target, source, time)
            except TransformUnavailableError:
                continue
            return self._sorted_in(target, source, found)
        self._asked.add((target, source))
        return None

    def _sorted_in(self, target: str, source: str, found: Transform) -> Transform:
        pair = (target, source)
        latest = self._latest.get(pair)
        if latest is not None and found.is_near(latest):
            found = latest
        self._latest[pair] = found
        if self._buffer.is_static(target, source):
            self._fixed[pair] = found
            self._asked.discard(pair)
        else:
            self._asked.add(pair)
        return found
