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
        self.samples: dict[int, Data | None] = {}
        self._pieces: dict[int, dict[int, bytes]] = {}

    @property
    def missing(self) -> list[int]:
        """The first numbers of what the writer says that it has, and that has not come."""
        last = self.first - 1 if self.last is None else self.last
        lacking = (number for number in range(self.first, last + 1) if number not in self.samples)
        return list(islice(lacking, _MOST))

    @property
    def whole(self) -> bool:
        """Whether all has come."""
        return self.last is not None and not self.missing

    def tell(self, heartbeat: Heartbeat) -> None:
        """Hear what there is."""
        self.first, self.last = heartbeat.first, max(heartbeat.last, self.last or 0)

    def lack(self, gap: Gap) -> None:
        """Hear what there is not."""
        for number in gap.numbers:
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
