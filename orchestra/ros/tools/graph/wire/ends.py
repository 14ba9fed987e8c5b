"""The ends of a topic with all that they say of themselves, as rclpy tells it (`TopicEndpointInfo`).

How many messages are kept nobody says on the wire, so that rmw_fastrtps does not know it either.
"""

from __future__ import annotations

import re
import struct
from typing import TYPE_CHECKING, Any, Final

from orchestra.dataclass import dataclass
from orchestra.ros.tools.graph.wire import parameters as known
from orchestra.ros.tools.graph.wire.endpoints import type_of

if TYPE_CHECKING:
    from orchestra.ros.tools.graph.wire.endpoints import Described
    from orchestra.ros.tools.graph.wire.names import Named

_RELIABILITY: Final = {1: "best_effort", 2: "reliable"}
_DURABILITY: Final = {0: "volatile", 1: "transient_local"}
_LIVELINESS: Final = {0: "automatic", 2: "manual_by_topic"}
_HASH: Final = re.compile(rb"typehash=([^;]+);")
_UNKNOWN: Final = "unknown"
_NOBODY: Final = ("_NODE_NAME_UNKNOWN_", "_NODE_NAMESPACE_UNKNOWN_")
_ENDLESS: Final = 0x7FFFFFFF  # s
_NANOSECONDS: Final = 1_000_000_000
_KIND, _SPAN = struct.calcsize("I"), struct.calcsize("iI")  # bytes; what is shorter tells nothing


@dataclass(frozen=True, slots=True)
class WireEnd:
    """A publisher or a subscription; `spans` are in nanoseconds, None for one without end."""

    node_name: str
    node_namespace: str
    topic_type: str
    topic_type_hash: str
    endpoint_gid: bytes
    writes: bool
    words: dict[str, str]
    spans: dict[str, int | None]

    @property
    def qos(self) -> dict[str, Any]:
        """The QoS as plain data: durations in seconds, None for endless ones."""
        seconds = {name: None if span is None else span / _NANOSECONDS for name, span in self.spans.items()}
        return {**self.words, "depth": 0, **seconds}

    def __str__(self) -> str:
        """Return what `ros2 topic info -v` tells of it."""
        words = {name: word.upper() for name, word in self.words.items()}
        spans = {
            name: "Infinite" if span is None else f"{span} nanoseconds" for name, span in self.spans.items()
        }
        return (
            f"Node name: {self.node_name}\nNode namespace: {self.node_namespace}\n"
            f"Topic type: {self.topic_type}\nTopic type hash: {self.topic_type_hash}\n"
            f"Endpoint type: {'PUBLISHER' if self.writes else 'SUBSCRIPTION'}\n"
            f"GID: {'.'.join(f'{byte:02x}' for byte in self.endpoint_gid)}\nQoS profile:\n"
            f"  Reliability: {words['reliability']}\n  History (Depth): {words['history']}\n"
            f"  Durability: {words['durability']}\n  Lifespan: {spans['lifespan']}\n"
            f"  Deadline: {spans['deadline']}\n  Liveliness: {words['liveliness']}\n"
            f"  Liveliness lease duration: {spans['liveliness_lease_duration']}"
        )


def end_of(one: Described, node: Named | None) -> WireEnd:
    """Return an endpoint of a node, None for one that is not known."""
    name, space = _NOBODY if node is None else (node.name, node.space)
    found = _HASH.search(one.fields.get(known.USER_DATA, b""))
    words = {
        "history": _UNKNOWN,
        "reliability": _word(
            one, known.RELIABILITY, _RELIABILITY, "reliable" if one.writes else "best_effort"
        ),
        "durability": _word(one, known.DURABILITY, _DURABILITY, "volatile"),
        "liveliness": _word(one, known.LIVELINESS, _LIVELINESS, "automatic"),
    }
    spans = {
        "lifespan": _span(one, known.LIFESPAN, 0),
        "deadline": _span(one, known.DEADLINE, 0),
        "liveliness_lease_duration": _span(one, known.LIVELINESS, _KIND),  # behind the kind
    }
    kind = found[1].decode("ascii", "replace") if found else "INVALID"
    return WireEnd(name, space, type_of(one.kind), kind, one.guid, one.writes, words, spans)


def _word(one: Described, which: int, words: dict[int, str], usual: str) -> str:
    value = one.fields.get(which, b"")
    if len(value) < _KIND:
        return usual
    (number,) = struct.unpack_from(f"{one.order}I", value)
    return words.get(number, _UNKNOWN)


def _span(one: Described, which: int, at: int) -> int | None:
    """Return a duration in nanoseconds, as Fast DDS reads it: the wire has fractions of a second."""
    value = one.fields.get(which, b"")
    if len(value) < at + _SPAN:
        return None
    seconds, fraction = struct.unpack_from(f"{one.order}iI", value, at)
    if seconds == _ENDLESS:
        return None
    return int(seconds) * _NANOSECONDS + _nanoseconds(fraction)


def _nanoseconds(fraction: int) -> int:
    return (fraction * _NANOSECONDS) >> 32
