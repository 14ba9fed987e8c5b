"""One participant that is asked: what it has said, and what is to be said to it next."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Final

from orchestra.ros.tools.graph.wire.own import READER, READERS
from orchestra.ros.tools.graph.wire.received import Received
from orchestra.ros.tools.graph.wire.submessages import (
    Acknowledgement,
    Data,
    Fragment,
    Gap,
    Heartbeat,
    acknowledgement,
    data,
    heartbeat,
)

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from orchestra.ros.tools.graph.wire.submessages import Heard

# What has not been answered is said again after this time, and then after twice as long each time, up to the longest;
# in seconds. Fast DDS sends 5 ms after it was asked; on a busy machine, asking once more makes it only busier.
_AGAIN: Final = 0.15
_LONGEST: Final = 0.5


class Peer:
    """A participant. `prefix` is ours as it knows us.

    It hears of participants on `port`, and of messages on `user_port`. It is told `said`, descriptions of endpoints of
    ours by the writer that tells them, and asked for all that the writers in `awaited` have.
    """

    def __init__(
        self, prefix: bytes, ports: tuple[int, int], said: Mapping[bytes, bytes], awaited: Iterable[bytes]
    ) -> None:
        self.prefix = prefix
        self.port, self.user_port = ports
        self.received: dict[bytes, Received] = {writer: Received() for writer in awaited}
        self.is_of_ros = False
        self.met_at = time.monotonic()
        self.reader: bytes | None = None  # that hears our writer
        self.heard_of: int = 0  # up to which our writer's samples have come there
        self._said = dict(said)
        self._at = 0.0
        self._patience = _AGAIN
        self._count = 0

    @property
    def writers(self) -> list[Received]:
        """What has come of writers that are not among those that each participant has."""
        return [received for writer, received in self.received.items() if writer not in READERS]

    def take(self, heard: Heard, now: float) -> Data | None:
        """Hear something; return a sample that is new."""
        if isinstance(heard, Acknowledgement):
            self._acknowledged(heard, now)
            return None
        if heard.writer not in self.received:
            if heard.writer in READERS or heard.writer[3] & 0xC0:
                return None
            self.received[heard.writer] = Received()
        received = self.received[heard.writer]
        sample = None
        if isinstance(heard, Data | Fragment):
            whole = heard if isinstance(heard, Data) else received.piece(heard)
            if whole is not None and received.take(whole):
                sample = whole
            more = received.next <= received.asked  # is on the way
            self._at, self._patience = now + _AGAIN if more else now, _AGAIN
        elif isinstance(heard, Gap):
            received.lack(heard)
        elif self._is_news(received, heard):
            received.tell(heard)
            self._at = now
        return sample

    @staticmethod
    def _is_news(received: Received, heard: Heartbeat) -> bool:
        return received.last is None or (heard.first, heard.last) > (received.first, received.last)

    def _acknowledged(self, heard: Acknowledgement, now: float) -> None:
        if heard.writer in self._said:
            if heard.base > 1:
                del self._said[heard.writer]
        elif heard.writer not in READERS:
            if self.reader is None:
                self._at = now
            self.reader = heard.reader
            self.heard_of = max(self.heard_of, heard.base - 1)

    def due(self, now: float) -> tuple[list[bytes], list[bytes]]:
        """Return what is to be said now, to the one port and to the other."""
        if now < self._at:
            return [], []
        discovery: list[bytes] = []
        user: list[bytes] = []
        for writer, payload in self._said.items():
            discovery += [
                data(READERS[writer], writer, 1, payload),
                heartbeat(READERS[writer], writer, 1, self._number()),
            ]
        for writer, received in self.received.items():
            if not received.whole and (received.last is not None or now - self.met_at >= _AGAIN):
                wanted = received.missing
                base = wanted[0] if wanted else 0
                received.asked = wanted[-1] if wanted else 0
                reader = READERS.get(writer, READER)
                asked = acknowledgement(reader, writer, base, wanted, self._number())
                (discovery if writer in READERS else user).append(asked)
        self._at, self._patience = now + self._patience, min(2 * self._patience, _LONGEST)
        return discovery, user

    def _number(self) -> int:
        self._count += 1
        return self._count
