"""A client of one service, that knows when a server has met it.

A server that has not discovered yet whom it answers sends its answer to nobody. Here a request is sent when the
server's writer has offered its samples to our reader, and its reader has acknowledged our writer: both have met us.

A writer of Fast DDS offers what it has once, or twice, to a reader that is new. Where that gets lost we come again
under another name.
"""

from __future__ import annotations

import struct
import time
from typing import TYPE_CHECKING, Any, Final

from orchestra.errors import RunError
from orchestra.ros.interfaces.cdr import decode, encode
from orchestra.ros.interfaces.wire import MalformedMessageError
from orchestra.ros.tools.graph.reply import Reply
from orchestra.ros.tools.graph.wire import parameters as known
from orchestra.ros.tools.graph.wire.member import Member
from orchestra.ros.tools.graph.wire.own import PUBLICATIONS, READER, SUBSCRIPTIONS, WRITER, endpoint
from orchestra.ros.tools.graph.wire.parameters import END, parameter
from orchestra.ros.tools.graph.wire.submessages import heartbeat, sample, to

if TYPE_CHECKING:
    from orchestra.ros.tools.graph.wire.peer import Peer
    from orchestra.ros.tools.graph.wire.submessages import Data

_ANYBODY: Final = b"\0\0\0\0"
_AGAIN, _LONGEST = 0.1, 0.5  # s until something is sent again, and at most
_LOST: Final = 0.5  # s after which a server that is there has offered something, else it got lost
_GUID: Final = 16


class Client:
    """A client: `kind` is the class of the service, of a package that is installed."""

    def __init__(self, domain: int, kind: Any, name: str) -> None:  # noqa: ANN401 - a class of an untyped package
        self._kind = kind
        self._number = 0
        self._requests: dict[int, bytes] = {}
        self._replies: dict[int, Reply] = {}
        self._count = 0
        self._met = 0
        self._at, self._patience = 0.0, _AGAIN
        package, _, rest = kind.__module__.partition(".")
        typed = f"{package}::{rest.partition('.')[0]}::dds_::{kind.__name__}"

        def writer(prefix: bytes, port: int) -> bytes:
            return endpoint(prefix + WRITER, f"rq{name}Request", f"{typed}_Request_", port)

        def reader(prefix: bytes, port: int) -> bytes:
            return endpoint(prefix + READER, f"rr{name}Reply", f"{typed}_Response_", port)

        self.member = Member(domain, self._hear, said={PUBLICATIONS: writer, SUBSCRIPTIONS: reader})

    def close(self) -> None:
        """Leave; nothing more is answered."""
        self.member.close()

    @property
    def _servers(self) -> dict[bytes, Peer]:
        """Those who have met both our reader and our writer."""
        return {
            source: peer
            for source, peer in self.member.peers.items()
            if peer.reader is not None and peer.writers
        }

    def service_is_ready(self) -> bool:
        """Tell whether a server is there, and has met us."""
        self.speak()
        return bool(self._servers)

    def call_async(self, request: Any) -> Reply:  # noqa: ANN401 - as above
        """Send a request."""
        self._number += 1
        self._requests[self._number] = encode(request)
        reply = self._replies[self._number] = Reply()
        self._at, self._patience = 0.0, _AGAIN
        self.speak()
        return reply

    def speak(self) -> None:
        """Say what is due: ask those who write to us whether they read us too, and send what has not come there."""
        now = time.monotonic()
        met = sum(bool(peer.writers) + (peer.reader is not None) for peer in self.member.peers.values())
        if met != self._met:  # somebody has come who has not heard all of it
            self._met, self._at, self._patience = met, 0.0, _AGAIN
        if now < self._at:
            return
        self._at, self._patience = now + self._patience, min(2 * self._patience, _LONGEST)
        for source, peer in [*self.member.peers.items()]:
            known_for = now - peer.met_at
            if not peer.writers and peer.reader is not None and known_for > 2 * _LOST:
                self.member.meet_again(source)
            elif (peer.writers or known_for > _LOST) and (
                peer.reader is None or peer.heard_of < self._number
            ):
                self._ask(source, peer)

    def _ask(self, source: bytes, peer: Peer) -> None:
        """Say how many requests there are, and send those that have not come to a server."""
        self._count += 1
        if peer.reader is not None and peer.writers:
            for number in range(peer.heard_of + 1, self._number + 1):
                for part in self._request(peer.prefix, number):
                    self.member.send(peer, to(source), part)
        self.member.send(peer, to(source), heartbeat(_ANYBODY, WRITER, self._number, self._count))

    def _request(self, prefix: bytes, number: int) -> list[bytes]:
        """Return a request in parts; it tells which reader is for the response."""
        identity = prefix + READER + struct.pack("<iI", 0, number)
        which = (known.RELATED_SAMPLE, known.RELATED_SAMPLE_OF_VENDOR)
        qos = b"".join(parameter(one, identity) for one in which) + END
        return sample(_ANYBODY, WRITER, number, self._requests[number], qos)

    def _hear(self, peer: Peer, heard: Data) -> None:
        identity = heard.qos.get(known.RELATED_SAMPLE, heard.qos.get(known.RELATED_SAMPLE_OF_VENDOR, b""))
        if heard.payload is None or identity[:_GUID] not in (peer.prefix + READER, peer.prefix + WRITER):
            return  # an answer to another client
        high, low = struct.unpack_from(f"{heard.order}iI", identity, _GUID)
        reply = self._replies.pop((high << 32) + low, None)
        if reply is None:
            return
        try:
            response = decode(heard.payload, self._kind.Response)
        except MalformedMessageError as error:
            name = self._kind.__name__
            raise RunError(f"the response is no {name} as it is known here: {error}") from None
        reply.come(response)
