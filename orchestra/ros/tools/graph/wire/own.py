"""What a participant of ours says of itself and its endpoints (DDSI-RTPS 2.5, 8.5.3, 8.5.4 and 9.6.3)."""

from __future__ import annotations

import struct
from typing import Final

from orchestra.ros.tools.graph.wire import parameters as known
from orchestra.ros.tools.graph.wire.parameters import END, LIST, locator, parameter, text
from orchestra.ros.tools.graph.wire.submessages import VENDOR, data, message

# The endpoints that each participant has, as writers and the readers that they are for.
PARTICIPANTS, PUBLICATIONS, SUBSCRIPTIONS = b"\x00\x01\x00\xc2", b"\x00\x00\x03\xc2", b"\x00\x00\x04\xc2"
READERS: Final = {
    PARTICIPANTS: b"\x00\x01\x00\xc7",
    PUBLICATIONS: b"\x00\x00\x03\xc7",
    SUBSCRIPTIONS: b"\x00\x00\x04\xc7",
}
# Which of them a participant has.
ANNOUNCER_AND_DETECTOR: Final = 0x03
TELLS: Final = {PUBLICATIONS: 0x04, SUBSCRIPTIONS: 0x10}
HEARS: Final = {PUBLICATIONS: 0x08, SUBSCRIPTIONS: 0x20}
# Our own endpoints, of which a participant has one of each kind at most.
READER, WRITER = b"\x00\x00\x01\x04", b"\x00\x00\x02\x03"
_PARTICIPANT: Final = b"\x00\x00\x01\xc1"
_VERSION: Final = b"\x02\x03\x00\x00"
_RELIABLE, _VOLATILE, _TRANSIENT_LOCAL = 2, 0, 1
_DISPOSED_AND_UNREGISTERED: Final = b"\x00\x00\x00\x03"


def announcement(prefix: bytes, port: int, endpoints: int, lease: int) -> bytes:
    """Return the message with which a participant makes itself known; its lease is in seconds."""
    fields = (
        parameter(known.VERSION, _VERSION),
        parameter(known.VENDOR, VENDOR + b"\0\0"),
        parameter(known.PARTICIPANT_GUID, prefix + _PARTICIPANT),
        parameter(known.METATRAFFIC_UNICAST, locator(port)),
        parameter(known.DEFAULT_UNICAST, locator(port)),
        parameter(known.PARTICIPANT_LEASE, struct.pack("<iI", lease, 0)),
        parameter(known.BUILTIN_ENDPOINTS, struct.pack("<I", endpoints)),
    )
    payload = b"".join((LIST, *fields, END))
    return message(prefix, data(READERS[PARTICIPANTS], PARTICIPANTS, 1, payload))


def farewell(prefix: bytes) -> bytes:
    """Return the message with which it leaves."""
    key = parameter(known.KEY_HASH, prefix + _PARTICIPANT)
    qos = key + parameter(known.STATUS, _DISPOSED_AND_UNREGISTERED) + END
    return message(prefix, data(READERS[PARTICIPANTS], PARTICIPANTS, 2, None, qos))


def endpoint(guid: bytes, topic: str, kind: str, port: int, *, lasting: bool = False) -> bytes:
    """Return the description of a reliable endpoint; a `lasting` one hears what was said before it was there."""
    durability = _TRANSIENT_LOCAL if lasting else _VOLATILE
    fields = (
        parameter(known.ENDPOINT_GUID, guid),
        parameter(known.UNICAST, locator(port)),
        parameter(known.PARTICIPANT_GUID, guid[:12] + _PARTICIPANT),
        parameter(known.TOPIC, text(topic)),
        parameter(known.TYPE, text(kind)),
        parameter(known.VERSION, _VERSION),
        parameter(known.VENDOR, VENDOR + b"\0\0"),
        parameter(known.DURABILITY, struct.pack("<I", durability)),
        parameter(known.RELIABILITY, struct.pack("<IiI", _RELIABLE, 0, 0)),
    )
    return b"".join((LIST, *fields, END))
