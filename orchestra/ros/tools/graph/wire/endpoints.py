"""The endpoints of all participants, under the names of ROS.

Source: the names of topics and services on the wire (REP 2007's `rt/`, `rq/` and `rr/`), and of their types.
"""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.ros.tools.graph.wire import parameters as known
from orchestra.ros.tools.graph.wire.member import Member
from orchestra.ros.tools.graph.wire.own import PUBLICATIONS, SUBSCRIPTIONS
from orchestra.ros.tools.graph.wire.parameters import described, read_text

if TYPE_CHECKING:
    from collections.abc import Container, Iterator

    from orchestra.ros.tools.graph.wire.peer import Peer
    from orchestra.ros.tools.graph.wire.submessages import Data

    Listed = list[tuple[str, list[str]]]

_TOPIC, _REQUEST, _REPLY = "rt/", "rq/", "rr/"
_ENDS: Final = {_REQUEST: "Request", _REPLY: "Reply"}
_TYPE: Final = "dds_::"
_HALVES: Final = ("_Request_", "_Response_")


@dataclass(frozen=True, slots=True)
class Described:
    """An endpoint, as it is described."""

    guid: bytes
    topic: str
    kind: str
    writes: bool
    fields: dict[int, bytes]
    order: str


class Endpoints:
    """All endpoints there are."""

    def __init__(self, domain: int) -> None:
        self.member = Member(domain, self._hear, awaited=(PUBLICATIONS, SUBSCRIPTIONS))
        self._found: dict[Peer, dict[bytes, tuple[int, Described | None]]] = {}
        self._counts: Counter[tuple[str, bool]] = Counter()
        self._counted_at = 0

    def complete(self) -> bool:
        """Tell whether nothing is missing."""
        return self.member.met() and all(
            received.whole for peer in self.member.peers.values() for received in peer.received.values()
        )

    def topics(self, of: Container[bytes] | None = None, *, writing: bool | None = None) -> Listed:
        """Return the topics of ROS with their types: all, or those of these endpoints that write, or do not."""
        return _gathered(
            (one.topic.removeprefix("rt"), type_of(one.kind))
            for one in self._all()
            if one.topic.startswith(_TOPIC)
            and (of is None or one.guid in of)
            and writing in (None, one.writes)
        )

    def services(self, of: Container[bytes] | None = None, *, serving: bool | None = None) -> Listed:
        """Return the services with their types: all, or those that these endpoints serve, or ask."""
        begin = {None: "r", True: _REQUEST, False: _REPLY}[serving]
        return _gathered(
            (name, kind)
            for one in self._all()
            if one.topic.startswith(begin)
            and (of is None or (one.guid in of and not one.writes))
            and (name := service(one.topic))
            and (kind := service_type(one.kind))
        )

    def ends(self, topic: str, *, writing: bool) -> list[Described]:
        """Return the endpoints of a topic, by its name on the wire, in the order of their identities."""
        found = [one for one in self._all() if (one.topic, one.writes) == (topic, writing)]
        return sorted(found, key=lambda one: one.guid)

    def count(self, topic: str, *, writing: bool) -> int:
        """Return how many endpoints a topic has, by its name on the wire."""
        if self._counted_at != self.member.changes:
            self._counted_at = self.member.changes
            self._counts = Counter((one.topic, one.writes) for one in self._all())
        return self._counts[topic, writing]

    def _all(self) -> Iterator[Described]:
        for peer in self.member.peers.values():
            for _, one in self._found.get(peer, {}).values():
                if one is not None:
                    yield one

    def _hear(self, peer: Peer, sample: Data) -> None:
        there = self._found.setdefault(peer, {})
        if sample.payload is None:  # it is no more
            guid, one = sample.qos.get(known.KEY_HASH, b""), None
        else:
            fields, order = described(sample.payload)
            guid = fields[known.ENDPOINT_GUID]
            topic, kind = (read_text(fields[which], order) for which in (known.TOPIC, known.TYPE))
            one = Described(guid, topic, kind, sample.writer == PUBLICATIONS, fields, order)
        if there.get(guid, (0,))[0] < sample.number:
            there[guid] = (sample.number, one)


def _gathered(found: Iterator[tuple[str, str]]) -> Listed:
    types: dict[str, set[str]] = {}
    for name, kind in found:
        types.setdefault(name, set()).add(kind)
    return [(name, sorted(kinds)) for name, kinds in sorted(types.items())]


def type_of(kind: str) -> str:
    """Return the type of messages by its name on the wire; one that is none of ROS as it is."""
    space, found, name = kind.partition(_TYPE)
    return f"{space.replace('::', '/')}{name[:-1]}" if found and name.endswith("_") else kind


def service(topic: str) -> str:
    """Return the service that a topic on the wire belongs to, nothing where it belongs to none."""
    end = _ENDS.get(topic[:3])
    return topic[2 : -len(end)] if end and topic.endswith(end) else ""


def service_type(kind: str) -> str:
    """Return the type of a service by that of its requests or responses on the wire; nothing where it is none."""
    space, found, name = kind.partition(_TYPE)
    half = next((half for half in _HALVES if name.endswith(half)), "")
    return f"{space.replace('::', '/')}{name.removesuffix(half)}" if found and half else ""
