"""The nodes of all participants: each publishes on one topic which it has (`ParticipantEntitiesInfo`)."""

from __future__ import annotations

import struct
import time
from typing import TYPE_CHECKING, Final

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
_GIDS_OF: Final = 2  # readers, writers


class Names:
    """The nodes of each participant."""

    def __init__(self, domain: int) -> None:
        self.member = Member(domain, self._hear, said={SUBSCRIPTIONS: _subscription}, awaited=(_WRITER,))
        self._found: dict[Peer, tuple[int, list[tuple[str, str]]]] = {}

    def complete(self) -> bool:
        """Tell whether those of all are known."""
        return self.member.met() and all(self._is_known(peer) for peer in self.member.peers.values())

    def nodes(self) -> list[tuple[str, str]]:
        """Return name and namespace of each node."""
        return [node for peer in self.member.peers.values() for node in self._found.get(peer, (0, []))[1]]

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


def _nodes(body: bytes, order: str) -> Iterator[tuple[str, str]]:
    """Yield name and namespace of each node in such a message."""
    count, at = _count(body, _GID, order)
    for _ in range(count):
        space, at = _text(body, at, order)
        name, at = _text(body, at, order)
        for _ in range(_GIDS_OF):
            gids, at = _count(body, at, order)
            at += gids * _GID
        yield name, space


def _count(body: bytes, at: int, order: str) -> tuple[int, int]:
    at += -at % 4
    return struct.unpack_from(f"{order}I", body, at)[0], at + 4


def _text(body: bytes, at: int, order: str) -> tuple[str, int]:
    size, at = _count(body, at, order)
    return body[at : at + size].rstrip(b"\0").decode(errors="replace"), at + size
