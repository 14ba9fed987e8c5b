"""What smoothing remembers, so that a late measurement can be fused at the time it belongs to."""

from bisect import bisect_left, bisect_right
from operator import attrgetter

from bringup.filter.estimator import Snapshot
from bringup.filter.measurement import Measurement

_stamp = attrgetter("stamp")


class History:
    """Estimates and fused measurements of the recent past, each list in the order of their stamps."""

    def __init__(self) -> None:
        self._snapshots: list[Snapshot] = []
        self._measurements: list[Measurement] = []

    def clear(self) -> None:
        """Forget everything."""
        self._snapshots.clear()
        self._measurements.clear()

    def keep(self, measurement: Measurement) -> None:
        """Remember a measurement that has been fused."""
        place = bisect_right(self._measurements, measurement.stamp, key=_stamp)
        self._measurements.insert(place, measurement)

    def save(self, snapshot: Snapshot) -> None:
        """Remember an estimate; one of the same time is replaced."""
        place = bisect_left(self._snapshots, snapshot.stamp, key=_stamp)
        if place < len(self._snapshots) and self._snapshots[place].stamp == snapshot.stamp:
            self._snapshots[place] = snapshot
        else:
            self._snapshots.insert(place, snapshot)

    def forget(self, before: int) -> None:
        """Drop what is older than a time."""
        del self._snapshots[: bisect_left(self._snapshots, before, key=_stamp)]
        del self._measurements[: bisect_left(self._measurements, before, key=_stamp)]

    def go_back(self, stamp: int) -> tuple[Snapshot, list[Measurement]] | None:
        """Go back to before a time: the estimate to restore and the measurements to fuse again.

        That is the newest estimate before `stamp`, or the oldest one if none is so old (the best that can be done).
        What the estimate contains already is not fused again; upstream does so in the second case. An empty
        history gives None.
        """
        if not self._snapshots:
            return None
        place = max(bisect_left(self._snapshots, stamp, key=_stamp) - 1, 0)
        snapshot = self._snapshots[place]
        del self._snapshots[place + 1 :]
        first = bisect_right(self._measurements, snapshot.stamp, key=_stamp)
        again = self._measurements[first:]
        del self._measurements[first:]
        return snapshot, again
