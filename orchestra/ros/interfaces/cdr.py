"""Messages as bytes, by the types of their fields: XCDR version 1, plain, final (OMG DDS-XTypes 1.3, section 7.4).

A serialized message is an encapsulation header of four bytes (byte order, options) and a body, in which every primitive
is aligned to its own size from the body's start. Strings are a `uint32` length, UTF-8 and NUL; sequences a `uint32`
count and their items. The types of fields are those of rosidl_parser, as every message class has them in `SLOT_TYPES`.
"""

from __future__ import annotations

import struct
import sys
from importlib import import_module
from typing import Any

from rosidl_parser.definition import AbstractGenericString, Array, BasicType, NamespacedType

from orchestra.ros.interfaces.wire import MalformedMessageError

_NATIVE_HEADER = b"\0\1\0\0" if sys.byteorder == "little" else b"\0\0\0\0"
_ORDERS = {b"\0\0": ">", b"\0\1": "<"}
_PRIMITIVES = {
    "boolean": "?",
    "octet": "c",
    "uint8": "B",
    "int8": "b",
    "uint16": "H",
    "int16": "h",
    "uint32": "I",
    "int32": "i",
    "uint64": "Q",
    "int64": "q",
    "float": "f",
    "double": "d",
}


def encode(message: Any) -> bytes:  # noqa: ANN401 - a message of any class
    """Serialize a message in this machine's byte order, header included.

    Raises:
        AttributeError, TypeError, UnicodeEncodeError, struct.error: a field is missing, of another type or out of
            range.
    """
    body = bytearray()
    _write_fields(body, message)
    return _NATIVE_HEADER + bytes(body)


def decode(data: bytes, kind: Any) -> Any:  # noqa: ANN401 - as above
    """Return the message of a class that the bytes, header included, stand for, in either byte order.

    Raises:
        MalformedMessageError: the bytes end too early, or the encoding is another one.
    """
    order = _ORDERS.get(data[:2])
    if order is None or len(data) < len(_NATIVE_HEADER):
        raise MalformedMessageError(f"no plain CDR message: it starts with {data[:4].hex() or 'nothing'}")
    try:
        return _Reader(data[4:], order).message(kind)
    except (struct.error, UnicodeDecodeError) as error:
        raise MalformedMessageError(f"a {kind.__name__} of {len(data) - 4} bytes: {error}") from error


def fields_of(kind: Any) -> list[tuple[str, Any]]:  # noqa: ANN401 - as above
    """Return the names and types of the fields of a message class."""
    return list(zip(kind.get_fields_and_field_types(), kind.SLOT_TYPES, strict=True))


def class_of(name: NamespacedType) -> Any:  # noqa: ANN401 - as above
    """Return the class of a message type."""
    return getattr(import_module(".".join(name.namespaces)), name.name)


def _write_fields(body: bytearray, message: Any) -> None:  # noqa: ANN401 - as above
    for name, kind in fields_of(type(message)):
        _write(body, kind, getattr(message, name))


def _write(body: bytearray, kind: Any, value: Any) -> None:  # noqa: ANN401 - as above
    if isinstance(kind, BasicType):
        code = _PRIMITIVES[kind.typename]
        body.extend(bytes(-len(body) % struct.calcsize(code)))
        body.extend(struct.pack(f"={code}", value))
    elif isinstance(kind, AbstractGenericString):
        text = value.encode().partition(b"\0")[0] + b"\0"
        _write(body, BasicType("uint32"), len(text))
        body.extend(text)
    elif isinstance(kind, NamespacedType):
        _write_fields(body, value)
    else:
        if not isinstance(kind, Array):
            _write(body, BasicType("uint32"), len(value))
        for item in value:
            _write(body, kind.value_type, item)


class _Reader:
    """Reads values from a body, one after another."""

    def __init__(self, body: bytes, order: str) -> None:
        self._body = body
        self._order = order
        self._position = 0

    def message(self, kind: Any) -> Any:  # noqa: ANN401 - as above
        made = kind()
        for name, field in fields_of(kind):
            setattr(made, name, self._value(field))
        return made

    def _value(self, kind: Any) -> Any:  # noqa: ANN401 - as above
        if isinstance(kind, BasicType):
            return self._primitive(_PRIMITIVES[kind.typename])
        if isinstance(kind, AbstractGenericString):
            return self._text()
        if isinstance(kind, NamespacedType):
            return self.message(class_of(kind))
        count = kind.size if isinstance(kind, Array) else self._primitive("I")
        return [self._value(kind.value_type) for _ in range(self._plausible(count))]

    def _primitive(self, code: str) -> Any:  # noqa: ANN401 - as above
        size = struct.calcsize(code)
        at = self._position + -self._position % size
        self._position = at + size
        return struct.unpack_from(self._order + code, self._body, at)[0]

    def _text(self) -> str:
        size = self._primitive("I")
        end = self._position + self._plausible(size)
        found = self._body[self._position : end].partition(b"\0")[0]
        self._position = end
        return found.decode()

    def _plausible(self, count: int) -> int:
        """Refuse a count that the rest of the body cannot hold; every item takes a byte at least."""
        if count > len(self._body) - self._position:
            raise MalformedMessageError(f"{count} items at {self._position} in a body of {len(self._body)}")
        return count
