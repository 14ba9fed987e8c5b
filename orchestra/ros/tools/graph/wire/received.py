"""What has come of a writer, and what has not."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING, Final

from orchestra.ros.tools.graph.wire.submessages import Data

if TYPE_CHECKING:
    from orchestra.ros.tools.graph.wire.submessages import Fragment, Gap, Heartbeat

_MOST: Final = 256  # that are asked for at once
LARGEST: Final = 1 << 26  # bytes of a sample that comes in pieces
_PIECES: Final = 1 << 16  # of a sample: those of Fast DDS have some kB each


class Received:
    """The samples of one writer that have come, by their numbers: of one that it has no more, nothing is missing."""

    def __init__(self) -> None:
        self.first = 1
        self.last: int | None = None  # until it tells
        self.asked = 0  # the last one that was asked for
        self.samples: dict[int, Data | None] = {}
        self._next = 1
        self._pieces: dict[int, _Pieces] = {}  # those that were begun, the latest last

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
        """Take some of a sample; return all of it once there is no more to come.

        Of a writer no more is kept so than its largest sample may have: what is begun makes room for what comes later,
        and is asked for again.
        """
        if fragment.whole > LARGEST or fragment.pieces > _PIECES or self.samples.get(fragment.number):
            return None
        pieces = self._pieces.pop(fragment.number, None)
        if pieces is None or not pieces.fit(fragment):
            pieces = _Pieces(fragment)
        self._pieces[fragment.number] = pieces
        while len(self._pieces) > _MOST or sum(one.whole for one in self._pieces.values()) > LARGEST:
            del self._pieces[next(iter(self._pieces))]
        pieces.take(fragment)
        if not pieces.complete:
            return None
        del self._pieces[fragment.number]
        return Data(fragment.writer, fragment.number, fragment.qos, bytes(pieces.content), fragment.order)


class _Pieces:
    """What has come of one sample, each piece in its place."""

    def __init__(self, fragment: Fragment) -> None:
        self.whole = fragment.whole
        self.content = bytearray(fragment.whole)
        self._size, self._count = fragment.size, fragment.pieces
        self._there: set[int] = set()

    @property
    def complete(self) -> bool:
        """Whether no piece is missing."""
        return len(self._there) == self._count

    def fit(self, fragment: Fragment) -> bool:
        """Tell whether these are pieces of the same sample."""
        return (self.whole, self._size) == (fragment.whole, fragment.size)

    def take(self, fragment: Fragment) -> None:
        """Put pieces in their places; one that has none, or is too short for it, is passed over."""
        for at in range(0, len(fragment.content), self._size):
            place = fragment.first - 1 + at // self._size
            begin, end = place * self._size, min((place + 1) * self._size, self.whole)
            content = fragment.content[at : at + end - begin]
            if 0 <= place < self._count and len(content) == end - begin:
                self.content[begin:end] = content
                self._there.add(place)
