"""TFMessage as bytes: XCDR version 1, plain, final (OMG DDS-XTypes 1.3, section 7.4).

A serialized message is an encapsulation header of four bytes (byte order, options) and a body, in which every
primitive is aligned to its own size from the body's start: a `uint32` count, then per transform `int32 sec`,
`uint32 nanosec`, two strings (`uint32` length, UTF-8, NUL) and seven `double`.
"""

from __future__ import annotations

import struct
import sys
from functools import lru_cache
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

_NATIVE_HEADER = b"\0\1\0\0" if sys.byteorder == "little" else b"\0\0\0\0"
_ORDERS = {b"\0\0": ">", b"\0\1": "<"}
_NUMBERS = {order: struct.Struct(order + "7d") for order in _ORDERS.values()}


class MalformedMessageError(ValueError):
    """Bytes that are no serialized TFMessage."""


def encode(transforms: Iterable[Any]) -> bytes:
    """Serialize transforms in this machine's byte order, header included.

    Integers are taken where the message has floats. Strings end at their first NUL, as in every ROS message.

    Raises:
        AttributeError, TypeError, UnicodeEncodeError, ValueError: a field is missing, of another type or out of
            range.
    """
    items = list(transforms)
    parts = [_NATIVE_HEADER, struct.pack("=I", len(items))]
    position = 4
    for item in items:
        part = _encode_transform(item, position % 8)
        parts.append(part)
        position += len(part)
    return b"".join(parts)


def _encode_transform(item: Any, phase: int) -> bytes:  # noqa: ANN401  # a geometry_msgs class, untyped
    stamp = item.header.stamp
    frame = _c_string(item.header.frame_id)
    child = _c_string(item.child_frame_id)
    move = item.transform.translation
    turn = item.transform.rotation
    try:
        return _transform_layout(len(frame), len(child), phase).pack(
            stamp.sec, stamp.nanosec, len(frame), frame, len(child), child,
            move.x, move.y, move.z, turn.x, turn.y, turn.z, turn.w,
        )  # fmt: skip
    except struct.error as error:
        raise TypeError(
            f"transform from {item.header.frame_id!r} to {item.child_frame_id!r}: {error}"
        ) from error


@lru_cache(maxsize=1024)
def _transform_layout(frame: int, child: int, phase: int) -> struct.Struct:
    """How a transform is packed that starts `phase` bytes after a multiple of 8; sizes count the final NUL."""
    after_frame = 12 + frame
    padding = -after_frame % 4
    after_child = phase + after_frame + padding + 4 + child
    return struct.Struct(f"=iII{frame}s{padding}xI{child}s{-after_child % 8}x7d")


def _c_string(value: str) -> bytes:
    return value.encode().partition(b"\0")[0] + b"\0"


def decode(message: bytes, new_transform: Callable[[], Any]) -> list[Any]:
    """Return the transforms of a serialized message, header included, in either byte order.

    Raises:
        MalformedMessageError: the bytes end too early, a length is impossible or the encoding is another one.
    """
    order = _ORDERS.get(message[:2])
    if order is None or len(message) < len(_NATIVE_HEADER):
        raise MalformedMessageError(f"no plain CDR message: it starts with {message[:4].hex() or 'nothing'}")
    body = memoryview(message)[4:]
    try:
        (count,) = struct.unpack_from(order + "I", body)
        transforms = []
        position = 4
        for _ in range(count):
            transform = new_transform()
            position = _decode_transform(transform, body, position, order)
            transforms.append(transform)
    except struct.error as error:
        raise MalformedMessageError(f"a TFMessage of {len(body)} bytes ends too early: {error}") from error
    return transforms


def _decode_transform(transform: Any, body: memoryview, position: int, order: str) -> int:  # noqa: ANN401  # as above
    stamp = transform.header.stamp
    stamp.sec, stamp.nanosec = struct.unpack_from(order + "iI", body, position + -position % 4)
    transform.header.frame_id, position = _decode_string(body, position + -position % 4 + 8, order)
    transform.child_frame_id, position = _decode_string(body, position + -position % 4, order)
    position += -position % 8
    move = transform.transform.translation
    turn = transform.transform.rotation
    numbers = _NUMBERS[order]
    move.x, move.y, move.z, turn.x, turn.y, turn.z, turn.w = numbers.unpack_from(body, position)
    return position + numbers.size


def _decode_string(body: memoryview, position: int, order: str) -> tuple[str, int]:
    (length,) = struct.unpack_from(order + "I", body, position)
    end = position + 4 + length
    if end > len(body):
        raise MalformedMessageError(f"a string of {length} bytes at {position} in a body of {len(body)}")
    text = bytes(body[position + 4 : end]).partition(b"\0")[0]
    return text.decode(errors="replace"), end


EMPTY = encode(())
