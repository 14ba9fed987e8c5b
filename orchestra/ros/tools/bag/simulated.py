"""The time of /clock at the moment at which each message came."""

from __future__ import annotations

import struct
from bisect import bisect_right
from typing import TYPE_CHECKING, Final

from rosgraph_msgs.msg import Clock

from orchestra.ros.tools.bag.taking import Tap

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rclpy.node import Node

    from orchestra.ros.tools.bag.storing import Message

_CLOCK: Final = "/clock"
_NANOSECONDS: Final = 1_000_000_000
_HEADER: Final = 4  # of a message in CDR; its second byte tells the order of bytes (DDSI-RTPS 10.5)


def simulated_time(node: Node) -> SimulatedTime:
    """Return the time that is heard on /clock."""
    return SimulatedTime(Tap(node, _CLOCK, Clock, (), lambda _count: None))


class SimulatedTime:
    """What is taken of /clock; until its first message nothing has a time."""

    def __init__(self, tap: Tap) -> None:
        self._tap = tap
        self._received: list[int] = []
        self._told: list[int] = []

    def stamped(self, messages: Sequence[Message]) -> list[Message]:
        """Return messages, in the order in which they came, with the time that /clock had told then."""
        for _, received, _, _, data in self._tap.take():
            self._received.append(received)
            self._told.append(time_of(data))
        found = []
        for topic, received, published, number, data in messages:
            place = bisect_right(self._received, received)
            if place:
                found.append((topic, self._told[place - 1], published, number, data))
        self._received, self._told = self._received[-1:], self._told[-1:]
        return found

    @property
    def told(self) -> bool:
        """Tell whether any time has come."""
        return bool(self._received)

    def close(self) -> None:
        """Hear nothing more."""
        self._tap.close()


def time_of(data: bytes) -> int:
    """Return the nanoseconds in a message of /clock, as the middleware carries it."""
    seconds, rest = struct.unpack_from("<iI" if data[1] & 1 else ">iI", data, _HEADER)
    return int(seconds) * _NANOSECONDS + int(rest)
