"""Messages as bytes, by the types of their fields: XCDR version 1, plain, final (OMG DDS-XTypes 1.3, section 7.4).

A serialized message is an encapsulation header of four bytes (byte order, options) and a body, in which every primitive
is aligned to its own size from the body's start. Strings are a `uint32` length, UTF-8 and NUL; wide strings a `uint32`
count and their UTF-16 units as a `uint32` each (so rosidl_typesupport_fastrtps_c); sequences a `uint32` count and
their items; a message without fields is one byte. The types of fields are those of rosidl_parser, as every message
class has them in `SLOT_TYPES`.
"""

from __future__ import annotations

import struct
import sys
from typing import Any, Final

from orchestra.ros.interfaces.coding import coder
from orchestra.ros.interfaces.wire import MalformedMessageError

_NATIVE_HEADER: Final = b"\0\1\0\0" if sys.byteorder == "little" else b"\0\0\0\0"
_ORDERS: Final = {b"\0\0": ">", b"\0\1": "<"}


def encode(message: Any) -> bytes:  # noqa: ANN401 - a message of any class
    """Serialize a message in this machine's byte order, header included.

    Raises:
        AttributeError, TypeError, ValueError, OverflowError, struct.error: a field is missing, of another type, too
            long or out of range.
    """
    body = bytearray()
    kind: Any = type(message)
    coder(kind).write(body, message)
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
        return coder(kind).read(data[len(_NATIVE_HEADER) :], 0, order)[0]
    except struct.error as error:
        raise MalformedMessageError(f"a {kind.__name__} of {len(data) - 4} bytes: {error}") from error
