"""A participant of ours that is there for one purpose, and makes itself known to each of this machine.

A participant answers the first announcement of another one at once, and later ones not at all. Where an answer gets
lost, we come again under another name.
"""

from __future__ import annotations

import os
import select
import socket
import struct
import time
from contextlib import suppress
from typing import TYPE_CHECKING, Final

from orchestra.ros.tools.graph.deaf import Deaf
from orchestra.ros.tools.graph.ports import ROOM, ports_here
from orchestra.ros.tools.graph.wire import parameters as known
from orchestra.ros.tools.graph.wire.own import (
    ANNOUNCER_AND_DETECTOR,
    HEARS,
    PARTICIPANTS,
    TELLS,
    announcement,
    farewell,
)
from orchestra.ros.tools.graph.wire.parameters import LOCALHOST, parameters, read_port
from orchestra.ros.tools.graph.wire.peer import Peer
from orchestra.ros.tools.graph.wire.submessages import VENDOR, Data, message, read, to

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from orchestra.ros.tools.graph.wire.submessages import Heard

_LARGEST: Final = 1 << 16
_STEP: Final = 0.01  # s between two looks at what is due
_PORTS_AGAIN: Final = 0.03
_CALL_AGAIN, _LONGEST = 0.2, 0.8  # s, after twice as long each time, and at most
_LEASE: Final = 20  # s, and it is renewed well before
_RENEW: Final = 5.0
_AT_ONCE: Final = 64  # messages, before what is due is looked at
_PREFIX_REST: Final = 10
_OF_ROS: Final = b"enclave="  # which a participant of ROS tells of


class Member:
    """The participant.

    `said` makes descriptions of endpoints of ours of our prefix and port, by the writer that tells them; `awaited` are
    writers of which all is asked for; `heard` gets each new sample of anybody.
    """

    def __init__(
        self,
        domain: int,
        heard: Callable[[Peer, Data], None],
        said: Mapping[bytes, Callable[[bytes, int], bytes]] | None = None,
        awaited: tuple[bytes, ...] = (),
    ) -> None:
        self._domain = domain
        self._heard = heard
        self._said = dict(said or {})
        self._awaited = awaited
        told = (
            *(TELLS[writer] for writer in self._said),
            *(HEARS[writer] for writer in awaited if writer in HEARS),
        )
        self._endpoints = ANNOUNCER_AND_DETECTOR | sum(told)
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM | socket.SOCK_NONBLOCK)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, ROOM)
        self._socket.bind((LOCALHOST, 0))
        self._own_port: int = self._socket.getsockname()[1]
        self._names: list[bytes] = []
        self._called: dict[
            int, tuple[bytes, float, float]
        ] = {}  # the name, when again, and how long after that
        self._ports: dict[int, str] = {}  # with the inodes of their sockets
        self.deaf = Deaf()
        self._ports_at = -_PORTS_AGAIN
        self._renew_at = time.monotonic() + _RENEW
        self.peers: dict[bytes, Peer] = {}
        self.news_at = time.monotonic()
        self.changes = 0  # of what is known

    def met(self) -> bool:
        """Tell whether all participants have answered that can."""
        self._look(time.monotonic())
        missing = self._missing()
        return len(self.deaf.among(missing)) == len(missing)

    def hear(self, seconds: float) -> None:
        """Hear what comes, and wait for it at most so long; say what is due."""
        until = time.monotonic() + seconds
        while True:
            now = time.monotonic()
            self._speak(now)
            left = until - now
            if select.select([self._socket], [], [], max(0.0, min(left, _STEP)))[0]:
                self._drain()
                self._speak(time.monotonic())
                return
            if left <= _STEP:
                return

    def send(self, peer: Peer, *parts: bytes) -> None:
        """Say something to one of whose endpoints this is."""
        self._send(peer.user_port, message(peer.prefix, *parts))

    def meet_again(self, source: bytes) -> None:
        """Forget somebody, and announce ourselves to him under another name."""
        del self.peers[source]
        self._changed(time.monotonic())

    def close(self) -> None:
        """Leave."""
        for name in self._names:
            for port in self._called:
                self._send(port, farewell(name))
        self._socket.close()

    def _drain(self) -> None:
        for _ in range(_AT_ONCE):
            try:
                datagram = self._socket.recv(_LARGEST)
            except BlockingIOError:
                return
            for source, heard in read(datagram):
                self._take(source, heard)

    def _take(self, source: bytes, heard: Heard) -> None:
        now = time.monotonic()
        if isinstance(heard, Data) and heard.writer == PARTICIPANTS:
            with suppress(struct.error):
                self._meet(source, heard, now)
            return
        peer = self.peers.get(source)
        if peer is None:
            return
        sample = peer.take(heard, now)
        if sample is not None:
            self._changed(now)
            # It may be no description: of somebody who does not keep to the protocol.
            with suppress(struct.error, LookupError):
                self._heard(peer, sample)

    def _meet(self, source: bytes, heard: Data, now: float) -> None:
        if heard.payload is None:
            self.peers.pop(source, None)
            self._changed(now)
            return
        if source in self.peers:
            return
        order = heard.order
        ports: dict[int, int] = {}
        is_of_ros = False
        for kind, value in parameters(heard.payload[4:], order):
            is_of_ros = is_of_ros or (kind == known.USER_DATA and _OF_ROS in value)
            if kind in (known.METATRAFFIC_UNICAST, known.DEFAULT_UNICAST):
                port = read_port(value, order)
                if port is not None:
                    ports.setdefault(kind, port)
        port = ports.get(known.METATRAFFIC_UNICAST)
        if port is None or port not in self._called:
            return
        for other in [prefix for prefix, peer in self.peers.items() if peer.port == port]:
            del self.peers[other]  # it has ended, and its port is another's now
        name = self._called[port][0]
        said = {writer: describe(name, self._own_port) for writer, describe in self._said.items()}
        peer = Peer(name, (port, ports.get(known.DEFAULT_UNICAST, port + 1)), said, self._awaited)
        peer.is_of_ros = is_of_ros
        self.peers[source] = peer
        self._changed(now)

    def _changed(self, now: float) -> None:
        self.news_at = now
        self.changes += 1

    def _speak(self, now: float) -> None:
        self._look(now)
        self._call(now)
        for source, peer in self.peers.items():
            discovery, user = peer.due(now)
            for port, parts in ((peer.port, discovery), (peer.user_port, user)):
                if parts:
                    self._send(port, message(peer.prefix, to(source), *parts))

    def _look(self, now: float) -> None:
        """Look who is there."""
        if now - self._ports_at < _PORTS_AGAIN:
            return
        self._ports_at = now
        self._ports = ports_here(self._domain)
        for gone in [source for source, peer in self.peers.items() if peer.port not in self._ports]:
            del self.peers[gone]
            self._changed(now)

    def _call(self, now: float) -> None:
        """Announce ourselves to those who have not answered."""
        fresh: bytes | None = None
        for port in self._missing():
            name, at, patience = self._called.get(port, (None, now, _CALL_AGAIN))
            if now < at:
                continue
            if name is not None or not self._names:
                fresh = fresh or self._new_name()
            self._called[port] = (self._names[-1], now + patience, min(2 * patience, _LONGEST))
            self._announce(self._names[-1], port)
        if now >= self._renew_at:
            self._renew_at = now + _RENEW
            for port, (name, *_) in self._called.items():
                self._announce(name, port)

    def _missing(self) -> dict[int, str]:
        """Return the ports of those who have not answered."""
        known_ports = {peer.port for peer in self.peers.values()}
        return {port: inode for port, inode in self._ports.items() if port not in known_ports}

    def _new_name(self) -> bytes:
        name = VENDOR + os.urandom(_PREFIX_REST)
        self._names.append(name)
        return name

    def _announce(self, name: bytes, port: int) -> None:
        self._send(port, announcement(name, self._own_port, self._endpoints, _LEASE))

    def _send(self, port: int, datagram: bytes) -> None:
        with suppress(OSError):  # it has gone, or cannot take more now: then it is said again
            self._socket.sendto(datagram, (LOCALHOST, port))
