"""The nodes of all participants: each publishes on one topic which it has, and whose its endpoints are."""

from __future__ import annotations

import struct
import time
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.ros.tools.graph.wire.member import Member
from orchestra.ros.tools.graph.wire.own import READER, SUBSCRIPTIONS, endpoint

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.ros.tools.graph.wire.peer import Peer
    from orchestra.ros.tools.graph.wire.submessages import Data

_TOPIC: Final = "ros_discovery_info"
_TYPE: Final = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_"
_WRITER: Final = b"\0\0\1\3"  # its first one; should it be another, that one is heard of all the same
_NAMELESS: Final = 2.0  # s, after which one that has said nothing is taken to have no nodes
_GID: Final = 16


@dataclass(frozen=True, slots=True)
class Named:
    """A node, with the identities of its readers and writers."""

    name: str
    space: str
    readers: frozenset[bytes]
    writers: frozenset[bytes]


class Names:
    """The nodes of each participant."""

    def __init__(self, domain: int) -> None:
        self.member = Member(domain, self._hear, said={SUBSCRIPTIONS: _subscription}, awaited=(_WRITER,))
        self._found: dict[Peer, tuple[int, list[Named]]] = {}

    def complete(self) -> bool:
        """Tell whether those of all are known."""
        return self.member.met() and all(self._is_known(peer) for peer in self.member.peers.values())

    def nodes(self) -> list[Named]:
        """Return the nodes, those of one participant after those of another."""
        peers = [peer for _, peer in sorted(self.member.peers.items())]
        return [node for peer in peers for node in self._found.get(peer, (0, []))[1]]

    def _is_known(self, peer: Peer) -> bool:
        if not peer.is_of_ros:
            return True
        if peer in self._found:
            return all(one.whole for one in peer.writers if one.samples)
        has_said_nothing = any(one.whole for one in peer.writers)
        return has_said_nothing and time.monotonic() - peer.met_at > _NAMELESS

    def _hear(self, peer: Peer, sample: Data) -> None:
        if sample.payload is None or sample.number < self._found.get(peer, (0,))[0]:
            return
        order = "<" if sample.payload[1] & 1 else ">"
        self._found[peer] = (sample.number, list(_nodes(sample.payload[4:], order)))


def _subscription(prefix: bytes, port: int) -> bytes:
    return endpoint(prefix + READER, _TOPIC, _TYPE, port, lasting=True)


def _nodes(body: bytes, order: str) -> Iterator[Named]:
    """Yield the nodes in such a message."""
    count, at = _count(body, _GID, order)
    for _ in range(count):
        space, at = _text(body, at, order)
        name, at = _text(body, at, order)
        readers, at = _gids(body, at, order)
        writers, at = _gids(body, at, order)
        yield Named(name, space, readers, writers)


def _gids(body: bytes, at: int, order: str) -> tuple[frozenset[bytes], int]:
    count, at = _count(body, at, order)
    end = at + count * _GID
    if end > len(body):
        raise struct.error("identities that are not there")
    return frozenset(body[one : one + _GID] for one in range(at, end, _GID)), end


def _count(body: bytes, at: int, order: str) -> tuple[int, int]:
    at += -at % 4
    return struct.unpack_from(f"{order}I", body, at)[0], at + 4


def _text(body: bytes, at: int, order: str) -> tuple[str, int]:
    size, at = _count(body, at, order)
    return body[at : at + size].rstrip(b"\0").decode(errors="replace"), at + size
