"""Makes participants of this machine name themselves once more.

A participant of Fast DDS answers the first announcement of another one at once, and only that one. The one that has
just been made announces itself before its own receivers are registered, so that it misses most of these answers (seen
with Fast DDS 2.14 by sniffing: 20 of 20 answers came within 6 ms, and none was taken), and learns of the others only by
their regular announcements, which takes up to 3 s.

So a second participant is announced for a moment, which consists of nothing but this announcement: its address is that
of the real one, whose receivers are there by now. It has no endpoints and no user data, so that it is not in the graph
of ROS, and it is taken back as soon as the answers are there; where that gets lost, its lease of a second ends it.
"""

from __future__ import annotations

import os
import socket
from typing import TYPE_CHECKING, Final

from orchestra.ros.tools.graph.wire.own import ANNOUNCER_AND_DETECTOR, announcement, farewell
from orchestra.ros.tools.graph.wire.parameters import LOCALHOST

if TYPE_CHECKING:
    from collections.abc import Iterable

_RANDOM: Final = 8
_LEASE: Final = 1  # s


class RollCall:
    """The announced participant: whoever hears of it names itself to the port `answers`.

    `host` are the first four bytes of the identity of all participants of this machine.
    """

    def __init__(self, host: bytes, answers: int) -> None:
        self._prefix = host + os.urandom(_RANDOM)
        self._answers = answers
        self._called: set[int] = set()
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM | socket.SOCK_NONBLOCK)

    def call(self, ports: Iterable[int]) -> None:
        """Announce it to participants."""
        message = announcement(self._prefix, self._answers, ANNOUNCER_AND_DETECTOR, _LEASE)
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
            self._socket.sendto(message, (LOCALHOST, port))
        except OSError:
            return  # it has gone, or hears nothing here: then it answers as late as it would have
