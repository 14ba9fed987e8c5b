"""Messages whose layout never changes, kept as the bytes that go out: to publish one is to write its numbers into them.

Filling a message object and letting rclpy serialise it costs 20 to 30 us for an odometry message, writing into its
bytes 4 us. Where a field lies is found by serialising the message with a mark in it, so that nothing here knows the
encoding but that numbers are little-endian.
"""

from __future__ import annotations

import struct
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from rclpy.serialization import serialize_message

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray
    from rclpy.node import Node
    from rclpy.qos import QoSProfile

# Messages have no types.
Message = Any
# Two numbers, of which the first bytes make a small one as well.
MARKS = (bytes(range(0x21, 0x29)), bytes(range(0x31, 0x39)))


class Wire:
    """One topic and the message that it carries, as bytes."""

    def __init__(self, node: Node, topic: str, message: Message, qos: QoSProfile) -> None:
        self._publisher = node.create_publisher(type(message), topic, qos)
        # What Publisher does, without asking each time whether it was destroyed and what it was given.
        self._send = self._publisher.handle.publish_raw
        self._listeners = self._publisher.handle.get_subscription_count
        self.bytes = bytearray(serialize_message(message))
        self._message = message

    def slot(self, path: str, form: str) -> Callable[..., None]:
        """What puts numbers into consecutive fields, the first of which is named, in a format of struct."""
        return partial(struct.Struct(f"<{form}").pack_into, self.bytes, offset(self._message, path, form[-1]))

    def view(self, path: str, form: str, count: int) -> NDArray[Any]:
        """The numbers of an array, the first of which is named, as one that can be written to."""
        return np.frombuffer(self.bytes, f"<{form}", count, offset(self._message, path, form))

    def doubles(self, path: str, count: int) -> memoryview[float]:
        """As a view, of doubles that are written one by one: numpy takes ten times as long for one."""
        begin = offset(self._message, path, "d")
        return memoryview(self.bytes)[begin : begin + 8 * count].cast("d")

    @property
    def heard(self) -> bool:
        """Whether anybody listens: a message that nobody can get need not be made."""
        return bool(self._listeners())

    def publish(self) -> None:
        """Send the message as it is now."""
        self._send(bytes(self.bytes))


def offset(message: Message, path: str, kind: str) -> int:
    """Where a number of a message (`pose.covariance.0`, `header.stamp.sec`) lies in its bytes; its `kind` as struct."""
    *way, last = path.split(".")
    owner = message
    for name in way:
        owner = getattr(owner, name)
    old = owner[int(last)] if last.isdigit() else getattr(owner, last)
    places = []
    for mark in MARKS:
        number = mark[: struct.calcsize(kind)]
        _put(owner, last, struct.unpack(f"<{kind}", number)[0])
        places.append(_places(bytes(serialize_message(message)), number))
    _put(owner, last, old)
    # A mark may lie in the padding between two fields, which is whatever the memory held before; both do not.
    (place,) = set.intersection(*places)
    return place


def _places(data: bytes, part: bytes) -> set[int]:
    """Where a part begins in some bytes."""
    return {at for at in range(len(data)) if data.startswith(part, at)}


def _put(owner: Message, name: str, value: float) -> None:
    if name.isdigit():
        owner[int(name)] = value
    else:
        setattr(owner, name, value)
