"""What has come of a writer, and what has not."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING, Final

from orchestra.ros.tools.graph.wire.submessages import Data

if TYPE_CHECKING:
    from orchestra.ros.tools.graph.wire.submessages import Fragment, Gap, Heartbeat

_MOST: Final = 256  # that are asked for at once


class Received:
    """The samples of one writer that have come, by their numbers: of one that it has no more, nothing is missing."""

    def __init__(self) -> None:
        self.first = 1
        self.last: int | None = None  # until it tells
        self.asked = 0  # the last one that was asked for
        self.samples: dict[int, Data | None] = {}
        self._next = 1
        self._pieces: dict[int, dict[int, bytes]] = {}

    @property
    def next(self) -> int:
        """The first number that has not come."""
        self._next = max(self._next, self.first)
        while self._next in self.samples:
            self._next += 1
        return self._next

    @property
    def missing(self) -> list[int]:
        """The first numbers of what the writer says that it has, and that has not come."""
        numbers = range(self.next, (self.last or 0) + 1)
        return list(islice((number for number in numbers if number not in self.samples), _MOST))

    @property
    def whole(self) -> bool:
        """Whether all has come."""
        return self.last is not None and self.next > self.last

    def tell(self, heartbeat: Heartbeat) -> None:
        """Hear what there is."""
        self.first, self.last = heartbeat.first, max(heartbeat.last, self.last or 0)

    def lack(self, gap: Gap) -> None:
        """Hear what there is not."""
        for number in (*islice(range(max(gap.start, self.next), gap.end), _MOST), *gap.some):
            self.samples.setdefault(number, None)

    def take(self, sample: Data) -> bool:
        """Take a sample; return whether it is new."""
        new = self.samples.get(sample.number) is None
        if new:
            self.samples[sample.number] = sample
        return new

    def piece(self, fragment: Fragment) -> Data | None:
        """Take some of a sample; return all of it once there is no more to come."""
        pieces = self._pieces.setdefault(fragment.number, {})
        for place in range(0, len(fragment.content), fragment.size):
            pieces[fragment.first + place // fragment.size] = fragment.content[place : place + fragment.size]
        if len(pieces) < -(-fragment.whole // fragment.size):
            return None
        del self._pieces[fragment.number]
        payload = b"".join(pieces[place] for place in sorted(pieces))[: fragment.whole]
        return Data(fragment.writer, fragment.number, fragment.qos, payload, fragment.order)
