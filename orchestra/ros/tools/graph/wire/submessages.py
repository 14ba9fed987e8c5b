"""The messages of the protocol and what is in them (DDSI-RTPS 2.5, 8.3 and 9.4)."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Final, NamedTuple

from orchestra.ros.tools.graph.wire.parameters import parameters

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

VENDOR: Final = b"\x01\x0f"  # whose answers are asked for
_HEADER: Final = b"RTPS\x02\x03" + VENDOR  # version 2.3
_SIZE: Final = 20  # of the header with the prefix
_ACKNACK, _HEARTBEAT, _GAP, _INFO_SOURCE, _INFO_DESTINATION, _DATA, _FRAGMENT = (
    6,
    7,
    8,
    0x0C,
    0x0E,
    0x15,
    0x16,
)
_MAYBE_EMPTY: Final = (0x01, 0x09)  # padding and time, where no size is none; else it is all that is left
_LITTLE_ENDIAN, _INLINE_QOS, _PAYLOAD = 1, 2, 4
_TO_INLINE_QOS: Final = 16
_TO_INLINE_QOS_OF_FRAGMENT: Final = 28
_PIECE: Final = 0xC000  # bytes of a sample, so that a piece with all in front of it is one datagram of UDP
_MOST: Final = 256  # numbers in a set
_BITS: Final = 32


class Data(NamedTuple):
    """A sample of a writer. `payload` is None where it only says that something is no more, which `qos` tells of."""

    writer: bytes
    number: int
    qos: dict[int, bytes]
    payload: bytes | None
    order: str


class Fragment(NamedTuple):
    """Some of a sample that is too large for one message: `first` counts from 1, in pieces of `size` bytes."""

    writer: bytes
    number: int
    first: int
    size: int
    whole: int
    qos: dict[int, bytes]
    content: bytes
    order: str

    @property
    def pieces(self) -> int:
        """How many pieces the sample has."""
        return -(-self.whole // self.size)


class Heartbeat(NamedTuple):
    """What numbers of samples a writer has."""

    writer: bytes
    first: int
    last: int


class Gap(NamedTuple):
    """Numbers of samples that there are none of: from one on to before another, and some."""

    writer: bytes
    start: int
    end: int
    some: frozenset[int]


class Acknowledgement(NamedTuple):
    """All samples of a writer of ours before number `base` have come; `wanted` have not."""

    reader: bytes
    writer: bytes
    base: int
    wanted: frozenset[int]


Heard = Data | Fragment | Heartbeat | Gap | Acknowledgement


def message(prefix: bytes, *parts: bytes) -> bytes:
    """Return a message of a participant."""
    return b"".join((_HEADER, prefix, *parts))


def to(prefix: bytes) -> bytes:
    """Return what says for whom the following is."""
    return _part(_INFO_DESTINATION, 0, prefix)


def data(reader: bytes, writer: bytes, number: int, payload: bytes | None, qos: bytes = b"") -> bytes:
    """Return a sample; `qos` is a whole list of parameters."""
    flags = (_INLINE_QOS if qos else 0) | (0 if payload is None else _PAYLOAD)
    head = struct.pack("<HH4s4s", 0, _TO_INLINE_QOS, reader, writer) + _number(number)
    return _part(_DATA, flags, head + qos + (payload or b""))


def sample(reader: bytes, writer: bytes, number: int, payload: bytes, qos: bytes) -> list[bytes]:
    """Return a sample of any size, as what each is to be sent in a message of its own."""
    if len(payload) <= _PIECE:
        return [data(reader, writer, number, payload, qos)]
    head = struct.pack("<HH4s4s", 0, _TO_INLINE_QOS_OF_FRAGMENT, reader, writer) + _number(number)
    return [
        _part(
            _FRAGMENT,
            _INLINE_QOS,
            head
            + struct.pack("<IHHI", 1 + at // _PIECE, 1, _PIECE, len(payload))
            + qos
            + payload[at : at + _PIECE],
        )
        for at in range(0, len(payload), _PIECE)
    ]


def heartbeat(reader: bytes, writer: bytes, last: int, count: int) -> bytes:
    """Return what asks whether all samples up to this one have come."""
    return _part(_HEARTBEAT, 0, reader + writer + _number(1) + _number(last) + struct.pack("<I", count))


def acknowledgement(reader: bytes, writer: bytes, base: int, wanted: Iterable[int], count: int) -> bytes:
    """Return what asks for samples, and tells that all before `base` have come; 0 asks which there are."""
    wanted = [number for number in wanted if number - base < _MOST]
    size = max(wanted) - base + 1 if wanted else 0
    words = [0] * -(-size // _BITS)
    for number in wanted:
        words[(number - base) // _BITS] |= 1 << (_BITS - 1 - (number - base) % _BITS)
    numbers = _number(base) + struct.pack(f"<I{len(words)}I", size, *words)
    return _part(_ACKNACK, 0, reader + writer + numbers + struct.pack("<I", count))


def _part(kind: int, flags: int, content: bytes) -> bytes:
    return struct.pack("<BBH", kind, _LITTLE_ENDIAN | flags, len(content)) + content


def _number(number: int) -> bytes:
    return struct.pack("<iI", number >> 32, number & 0xFFFFFFFF)


def read(datagram: bytes) -> Iterator[tuple[bytes, Heard]]:
    """Yield what is in a message, each with the prefix of whose it is; what is not understood is passed over."""
    if not datagram.startswith(b"RTPS"):
        return
    source, at = datagram[8:_SIZE], _SIZE
    while at + 4 <= len(datagram):
        kind, flags = datagram[at], datagram[at + 1]
        order = "<" if flags & _LITTLE_ENDIAN else ">"
        (size,) = struct.unpack_from(f"{order}H", datagram, at + 2)
        end = at + 4 + size if size or kind in _MAYBE_EMPTY else len(datagram)
        content = datagram[at + 4 : end]
        at = end
        if kind == _INFO_SOURCE:
            source = content[8:_SIZE]
        elif kind in _READERS:
            try:
                heard = _READERS[kind](content, flags, order)
            except struct.error:
                return
            yield source, heard


def _data(content: bytes, flags: int, order: str) -> Data:
    to_qos, _, writer, high, low = struct.unpack_from(f"{order}2xH4s4siI", content)
    qos, at = _qos(content, 4 + to_qos, flags, order)
    payload = content[at:] if flags & _PAYLOAD else None
    return Data(writer, (high << 32) + low, qos, payload, order)


def _fragment(content: bytes, flags: int, order: str) -> Fragment:
    to_qos, _, writer, high, low, first, _, size, whole = struct.unpack_from(f"{order}2xH4s4siIIHHI", content)
    if not size:
        raise struct.error("pieces of nothing")
    qos, at = _qos(content, 4 + to_qos, flags, order)
    return Fragment(writer, (high << 32) + low, first, size, whole, qos, content[at:], order)


def _qos(content: bytes, at: int, flags: int, order: str) -> tuple[dict[int, bytes], int]:
    """Return the parameters in front of a payload, and where that begins."""
    if not flags & _INLINE_QOS:
        return {}, at
    found = {}
    for kind, value in parameters(content[at:], order):
        found[kind] = value
        at += 4 + len(value)
    return found, at + 4


def _heartbeat(content: bytes, _flags: int, order: str) -> Heartbeat:
    _, writer, high, low, last_high, last_low = struct.unpack_from(f"{order}4s4siIiI", content)
    return Heartbeat(writer, (high << 32) + low, (last_high << 32) + last_low)


def _gap(content: bytes, _flags: int, order: str) -> Gap:
    _, writer, high, low = struct.unpack_from(f"{order}4s4siI", content)
    base, some = _set(content, 16, order)
    return Gap(writer, (high << 32) + low, base, some)


def _acknowledgement(content: bytes, _flags: int, order: str) -> Acknowledgement:
    reader, writer = struct.unpack_from("4s4s", content)
    return Acknowledgement(reader, writer, *_set(content, 8, order))


def _set(content: bytes, at: int, order: str) -> tuple[int, frozenset[int]]:
    high, low, size = struct.unpack_from(f"{order}iII", content, at)
    base = (high << 32) + low
    size = min(size, _MOST)
    words = struct.unpack_from(f"{order}{-(-size // _BITS)}I", content, at + 12)
    bits = (words[place // _BITS] >> (_BITS - 1 - place % _BITS) & 1 for place in range(size))
    return base, frozenset(base + place for place, bit in enumerate(bits) if bit)


_READERS: Final[dict[int, Callable[[bytes, int, str], Heard]]] = {
    _ACKNACK: _acknowledgement,
    _HEARTBEAT: _heartbeat,
    _GAP: _gap,
    _DATA: _data,
    _FRAGMENT: _fragment,
}
