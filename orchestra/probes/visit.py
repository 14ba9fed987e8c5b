"""One attempt to reach a server: find its addresses, then talk with it."""

from __future__ import annotations

import errno
import os
import socket
from collections.abc import Callable
from typing import TYPE_CHECKING, TypeAlias

from orchestra.probes.conversation import Conversation, Steps, reason

if TYPE_CHECKING:
    from orchestra.probes.address import Address, Addresses
    from orchestra.probes.protocol import Cancel, Site

# How long one attempt may take, from the first packet to the last, in seconds.
WITHIN = 2.0

# Of a machine that has no IPv6, which says nothing of the server.
_NO_SUCH_ADDRESSES = frozenset(
    os.strerror(code).lower() for code in (errno.EADDRNOTAVAIL, errno.EAFNOSUPPORT)
)

# What is done with a connected socket.
Talk: TypeAlias = Callable[[socket.socket], Steps]


class Visit:
    """Connects to the first address that accepts, and talks; `told` hears None where all went well."""

    def __init__(
        self, site: Site, addresses: Addresses, talk: Talk, told: Callable[[str | None], None]
    ) -> None:
        self._site = site
        self._talk = talk
        self._told = told
        self._current: Cancel | None = None
        looking = addresses.find(site, self._found)
        self._current = self._current or looking

    def cancel(self) -> None:
        """Break off."""
        if self._current:
            self._current.cancel()

    def _found(self, addresses: list[Address], fault: str | None) -> None:
        if fault is not None:
            self._told(fault)
        else:
            steps = _visit(addresses, self._talk)
            self._current = Conversation(self._site.loop, steps, WITHIN, self._told)


def nothing(_peer: socket.socket) -> Steps:
    """Say nothing: that somebody accepts is enough."""
    return None
    yield


def _visit(addresses: list[Address], talk: Talk) -> Steps:
    faults: list[str] = []
    for family, address in addresses:
        try:
            with socket.socket(family, socket.SOCK_STREAM | socket.SOCK_NONBLOCK) as peer:
                fault = yield from _connect(peer, address)
                if fault is None:
                    return (yield from talk(peer))
        except OSError as error:
            fault = reason(error)
        faults.append(fault)
    telling = [fault for fault in faults if fault not in _NO_SUCH_ADDRESSES]
    return (telling or faults or ["no address"])[-1]


def _connect(peer: socket.socket, address: tuple[object, ...]) -> Steps:
    code = peer.connect_ex(address)
    if code in (errno.EINPROGRESS, errno.EAGAIN, errno.EINTR):
        yield peer.fileno(), "write"
        code = peer.getsockopt(socket.SOL_SOCKET, socket.SO_ERROR)
    if code:
        return os.strerror(code).lower()
    if peer.getsockname() == peer.getpeername():
        # The kernel has chosen the very port that is called as ours (a simultaneous open): nobody else is there. The
        # port must be free again at once, for it is the server's.
        peer.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")
        return os.strerror(errno.ECONNREFUSED).lower()
    return None
