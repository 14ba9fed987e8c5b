"""Parameter lists, in which participants and endpoints describe themselves (DDSI-RTPS 2.5, 9.4.2.11 and 9.6.3)."""

from __future__ import annotations

import socket
import struct
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

# The numbers of parameters.
PARTICIPANT_LEASE, TOPIC, TYPE, VERSION, VENDOR = 0x02, 0x05, 0x07, 0x15, 0x16
RELIABILITY, LIVELINESS, DURABILITY, DEADLINE, LIFESPAN = 0x1A, 0x1B, 0x1D, 0x23, 0x2B
USER_DATA, UNICAST = 0x2C, 0x2F
DEFAULT_UNICAST, METATRAFFIC_UNICAST, PARTICIPANT_GUID, BUILTIN_ENDPOINTS = 0x31, 0x32, 0x50, 0x58
ENDPOINT_GUID, KEY_HASH, STATUS, RELATED_SAMPLE = 0x5A, 0x70, 0x71, 0x83
RELATED_SAMPLE_OF_VENDOR: Final = 0x800F  # under which Fast DDS has it, too
_END: Final = 0x01
LIST: Final = b"\x00\x03\x00\x00"  # the encapsulation of a list, little-endian
END: Final = b"\x01\x00\x00\x00"
LOCALHOST: Final = "127.0.0.1"
_UDP4: Final = 1
_HEADS: Final = {order: struct.Struct(f"{order}HH") for order in "<>"}
_LOCATOR: Final = "iI12x4s"


def parameter(kind: int, value: bytes) -> bytes:
    """Return one parameter."""
    return struct.pack("<HH", kind, len(value)) + value


def text(value: str) -> bytes:
    """Return a text as the value of a parameter."""
    raw = value.encode() + b"\0"
    return struct.pack("<I", len(raw)) + raw + bytes(-len(raw) % 4)


def locator(port: int) -> bytes:
    """Return where on this machine somebody listens, as the value of a parameter."""
    return struct.pack(f"<{_LOCATOR}", _UDP4, port, socket.inet_aton(LOCALHOST))


def parameters(content: bytes, order: str) -> Iterator[tuple[int, bytes]]:
    """Yield the parameters of a list. Raises `struct.error` where it is broken off."""
    head, at = _HEADS[order], 0
    while True:
        kind, size = head.unpack_from(content, at)
        if kind == _END:
            return
        yield kind, content[at + 4 : at + 4 + size]
        at += 4 + size


def described(payload: bytes) -> tuple[dict[int, bytes], str]:
    """Return the parameters of a description, of several of a kind the last, and the order of its bytes."""
    order = "<" if payload[1] & 1 else ">"
    return dict(parameters(payload[4:], order)), order


def read_text(value: bytes, order: str) -> str:
    """Return the text that is the value of a parameter."""
    (size,) = struct.unpack_from(f"{order}I", value)
    return value[4 : 4 + size].rstrip(b"\0").decode(errors="replace")


def read_port(value: bytes, order: str) -> int | None:
    """Return the UDP port of a locator, None for one of another kind."""
    kind, port, _ = struct.unpack(order + _LOCATOR, value)
    return port if kind == _UDP4 else None
