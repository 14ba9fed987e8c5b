"""How single values are written and read, and sequences and arrays of them."""

from __future__ import annotations

import struct
import sys
from array import array
from typing import Any, Final, Protocol

from rosidl_parser.definition import (
    AbstractGenericString,
    AbstractNestedType,
    AbstractWString,
    Array,
    BasicType,
    BoundedSequence,
)

from orchestra.ros.interfaces.slots import TYPE_CODES
from orchestra.ros.interfaces.wire import MalformedMessageError

# The primitives that `struct` takes as a message has them.
CODES: Final = {**TYPE_CODES, "boolean": "?", "octet": "c"}
_NATIVE: Final = "<" if sys.byteorder == "little" else ">"
_CHARACTERS: Final = {"char": "B", "wchar": "I"}
_COUNT: Final = {order: struct.Struct(f"{order}I") for order in "<>="}


class Value(Protocol):
    """Writes a value, and reads it."""

    def write(self, body: bytearray, value: Any) -> None:  # noqa: ANN401 - a value of the field's type
        """Append the value."""

    def read(self, data: bytes, at: int, order: str) -> tuple[Any, int]:
        """Return the value that begins at a place, and where it ends."""


def value_of(kind: Any, item: Value | None = None) -> Value:  # noqa: ANN401 - a type of rosidl_parser
    """Return how values of a type are written and read; `item` is for those of an array or sequence."""
    if isinstance(kind, AbstractNestedType):
        if isinstance(kind.value_type, BasicType) and kind.value_type.typename in CODES:
            return _Numbers(kind)
        return _Items(kind, item or value_of(kind.value_type))
    if isinstance(kind, AbstractWString):
        return _WideText()
    if isinstance(kind, AbstractGenericString):
        return _Text()
    if kind.typename in _CHARACTERS:
        return _Character(_CHARACTERS[kind.typename])
    return _Number(CODES[kind.typename])


def _write_count(body: bytearray, count: int) -> None:
    body += bytes(-len(body) % 4)
    body += _COUNT["="].pack(count)


def _read_count(data: bytes, at: int, order: str, size: int = 1) -> tuple[int, int]:
    """Read a count of items; refuse one that the rest cannot hold, `size` being what an item takes at least."""
    at += -at % 4
    (count,) = _COUNT[order].unpack_from(data, at)
    return _plausible(count, data, at + 4, size), at + 4


def _plausible(count: int, data: bytes, at: int, size: int) -> int:
    if count * size > len(data) - at:
        raise MalformedMessageError(f"{count} items at {at} in a body of {len(data)}")
    return count


class _Number:
    def __init__(self, code: str) -> None:
        self._code = code
        self._size = struct.calcsize(f"={code}")

    def write(self, body: bytearray, value: Any) -> None:  # noqa: ANN401 - as above
        body += bytes(-len(body) % self._size)
        body += struct.pack(f"={self._code}", value)

    def read(self, data: bytes, at: int, order: str) -> tuple[Any, int]:
        at += -at % self._size
        return struct.unpack_from(order + self._code, data, at)[0], at + self._size


class _Character(_Number):
    def write(self, body: bytearray, value: Any) -> None:  # noqa: ANN401 - as above
        super().write(body, ord(value))

    def read(self, data: bytes, at: int, order: str) -> tuple[Any, int]:
        number, at = super().read(data, at, order)
        return chr(number), at


class _Text:
    """A string; it ends at its first NUL, as in every ROS message, and bytes that are no text are replaced."""

    def write(self, body: bytearray, value: Any) -> None:  # noqa: ANN401 - as above
        text = value.encode().partition(b"\0")[0] + b"\0"
        _write_count(body, len(text))
        body += text

    def read(self, data: bytes, at: int, order: str) -> tuple[Any, int]:
        size, at = _read_count(data, at, order)
        return data[at : at + size].partition(b"\0")[0].decode(errors="replace"), at + size


class _WideText:
    def write(self, body: bytearray, value: Any) -> None:  # noqa: ANN401 - as above
        units = array("H", value.encode(f"utf-16-{sys.byteorder[0]}e"))
        _write_count(body, len(units))
        body += array("I", units).tobytes()

    def read(self, data: bytes, at: int, order: str) -> tuple[Any, int]:
        count, at = _read_count(data, at, order, 4)
        end = at + 4 * count
        units = struct.unpack_from(f"{order}{count}I", data, at)
        if any(unit > 0xFFFF for unit in units):  # noqa: PLR2004 - what 16 bits hold
            raise MalformedMessageError(f"a unit at {at} is not of UTF-16")
        text = array("H", units).tobytes().decode(f"utf-16-{sys.byteorder[0]}e", errors="replace")
        return text, end


class _Items:
    """Items of which each has a length of its own."""

    def __init__(self, kind: Any, item: Value) -> None:  # noqa: ANN401 - as above
        self._kind = kind
        self._item = item

    def write(self, body: bytearray, value: Any) -> None:  # noqa: ANN401 - as above
        _write_size(body, self._kind, len(value))
        for each in value:
            self._item.write(body, each)

    def read(self, data: bytes, at: int, order: str) -> tuple[Any, int]:
        count, at = _read_size(data, at, order, self._kind, 1)
        found = []
        for _ in range(count):
            each, at = self._item.read(data, at, order)
            found.append(each)
        return found, at


class _Numbers:
    """Primitives, all of one size: in memory as on the wire."""

    def __init__(self, kind: Any) -> None:  # noqa: ANN401 - as above
        self._kind = kind
        typename = kind.value_type.typename
        self._code = CODES[typename]
        self._size = struct.calcsize(f"={self._code}")
        self._is_compact = typename in TYPE_CODES

    def write(self, body: bytearray, value: Any) -> None:  # noqa: ANN401 - as above
        count = len(value)
        _write_size(body, self._kind, count)
        if count:
            body += bytes(-len(body) % self._size)
        if isinstance(value, array) and value.typecode == self._code:
            body += value.tobytes()
        elif count:
            items = value.tolist() if hasattr(value, "tolist") else value
            body += struct.pack(f"={count}{self._code}", *items)

    def read(self, data: bytes, at: int, order: str) -> tuple[Any, int]:
        count, at = _read_size(data, at, order, self._kind, self._size)
        if count:
            at += -at % self._size
        end = at + count * self._size
        _plausible(count, data, at, self._size)
        if not self._is_compact:
            return list(struct.unpack_from(f"{order}{count}{self._code}", data, at)), end
        found = array(self._code, data[at:end])
        if order != _NATIVE:
            found.byteswap()
        if not isinstance(self._kind, Array):
            return found, end
        import numpy as np  # noqa: PLC0415 - few messages have such fields

        return np.array(found, dtype=np.dtype(self._code)), end


def _write_size(body: bytearray, kind: Any, size: int) -> None:  # noqa: ANN401 - as above
    if isinstance(kind, Array):
        if size != kind.size:
            raise ValueError(f"{size} items in an array of {kind.size}")
        return
    if isinstance(kind, BoundedSequence) and size > kind.maximum_size:
        raise ValueError(f"{size} items in a sequence of at most {kind.maximum_size}")
    _write_count(body, size)


def _read_size(data: bytes, at: int, order: str, kind: Any, size: int) -> tuple[int, int]:  # noqa: ANN401 - as above
    if isinstance(kind, Array):
        return _plausible(kind.size, data, at, size), at
    count, at = _read_count(data, at, order, size)
    if isinstance(kind, BoundedSequence) and count > kind.maximum_size:
        raise MalformedMessageError(f"{count} items at {at} in a sequence of at most {kind.maximum_size}")
    return count, at
