"""Makes participants of this machine name themselves once more.

A participant of Fast DDS answers the first announcement of another one at once, and only that one. The one that has
just been made announces itself before its own receivers are registered, so that it misses most of these answers (seen
with Fast DDS 2.14 by sniffing: 20 of 20 answers came within 6 ms, and none was taken), and learns of the others only by
their regular announcements, which takes up to 3 s.

So a second participant is announced for a moment, which consists of nothing but this announcement: its address is that
of the real one, whose receivers are there by now. It has no endpoints and no user data, so that it is not in the graph
of ROS, and it is taken back as soon as the answers are there; where that gets lost, its lease of a second ends it.

Source: DDSI-RTPS 2.5, 8.5.3 (participant discovery), 9.4 (messages), 9.6.3 (parameters).
"""

from __future__ import annotations

import os
import socket
import struct
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterable

_LOCALHOST: Final = "127.0.0.1"
_HEADER: Final = b"RTPS\x02\x03\x01\x0f"  # version 2.3, and the vendor whose answers are asked for
_DATA, _LITTLE_ENDIAN, _INLINE_QOS, _PAYLOAD = 0x15, 0x01, 0x02, 0x04
_TO_INLINE_QOS: Final = 16
_READER, _WRITER = b"\x00\x01\x00\xc7", b"\x00\x01\x00\xc2"
_PARTICIPANT: Final = b"\x00\x00\x01\xc1"
_PARAMETER_LIST: Final = b"\x00\x03\x00\x00"
_SENTINEL: Final = b"\x01\x00\x00\x00"
_VERSION, _VENDOR, _GUID, _UNICAST, _LEASE, _ENDPOINTS = 0x15, 0x16, 0x50, 0x32, 0x02, 0x58
_KEY_HASH, _STATUS = 0x70, 0x71
_UDP4: Final = 1
_ANNOUNCER_AND_DETECTOR: Final = 3
_DISPOSED_AND_UNREGISTERED: Final = b"\x00\x00\x00\x03"
_LEASE_SECONDS: Final = 1


class RollCall:
    """The announced participant: whoever hears of it names itself to the port `answers`.

    `host` are the first four bytes of the identity of all participants of this machine.
    """

    def __init__(self, host: bytes, answers: int) -> None:
        self._prefix = host + os.urandom(8)
        self._answers = answers
        self._called: set[int] = set()
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM | socket.SOCK_NONBLOCK)

    def call(self, ports: Iterable[int]) -> None:
        """Announce it to participants."""
        message = announcement(self._prefix, self._answers)
        for port in ports:
            self._send(message, port)
            self._called.add(port)

    def close(self) -> None:
        """Take it back."""
        message = farewell(self._prefix)
        for port in self._called:
            self._send(message, port)
        self._socket.close()

    def _send(self, message: bytes, port: int) -> None:
        try:
            self._socket.sendto(message, (_LOCALHOST, port))
        except OSError:
            return  # it has gone, or hears nothing here: then it answers as late as it would have


def announcement(prefix: bytes, port: int) -> bytes:
    """Return the message with which a participant makes itself known."""
    locator = struct.pack("<iI12x4s", _UDP4, port, socket.inet_aton(_LOCALHOST))
    fields = (
        _parameter(_VERSION, b"\x02\x03\x00\x00"),
        _parameter(_VENDOR, b"\x01\x0f\x00\x00"),
        _parameter(_GUID, prefix + _PARTICIPANT),
        _parameter(_UNICAST, locator),
        _parameter(_LEASE, struct.pack("<iI", _LEASE_SECONDS, 0)),
        _parameter(_ENDPOINTS, struct.pack("<I", _ANNOUNCER_AND_DETECTOR)),
        _SENTINEL,
    )
    return _message(prefix, 1, _PAYLOAD, _PARAMETER_LIST + b"".join(fields))


def farewell(prefix: bytes) -> bytes:
    """Return the message with which it leaves."""
    key = prefix + _PARTICIPANT
    fields = (_parameter(_KEY_HASH, key), _parameter(_STATUS, _DISPOSED_AND_UNREGISTERED), _SENTINEL)
    return _message(prefix, 2, _INLINE_QOS, b"".join(fields))


def _message(prefix: bytes, number: int, flag: int, content: bytes) -> bytes:
    body = struct.pack("<HH4s4siI", 0, _TO_INLINE_QOS, _READER, _WRITER, 0, number) + content
    head = struct.pack("<BBH", _DATA, _LITTLE_ENDIAN | flag, len(body))
    return _HEADER + prefix + head + body


def _parameter(kind: int, value: bytes) -> bytes:
    return struct.pack("<HH", kind, len(value)) + value
