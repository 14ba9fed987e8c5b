"""Whether anybody is where the discovery servers should be.

A client of a server that is not there waits for it without a word, and its graph is empty. A port of UDP that nobody
has refuses what comes, where the machine is this one or says so.
"""

from __future__ import annotations

import re
import socket
from contextlib import suppress
from typing import Final

_DEFAULT_PORT: Final = 11811
# Fast DDS: addresses with semicolons between, some of which may be left out.
_ADDRESS: Final = re.compile(r"(?:(?P<host>[^:\[\]]+)|\[(?P<v6>[^\]]+)\])(?::(?P<port>[0-9]+))?")
_HEADER: Final = b"RTPS\x02\x03\x01\x0f" + bytes(12)  # a message with nothing in it


class Servers:
    """The servers of a setting; each is sent an empty message."""

    def __init__(self, setting: str) -> None:
        self._setting = setting
        self._called = [_call(*address) for address in addresses(setting)]

    def complaint(self) -> str | None:
        """Return what to tell where each of them has refused it."""
        try:
            if self._called and all(one is not None and _has_refused(one) for one in self._called):
                return f"nobody answers at {self._setting}, which ROS_DISCOVERY_SERVER names"
            return None
        finally:
            for one in self._called:
                if one is not None:
                    one.close()


def addresses(setting: str) -> list[tuple[str, int]]:
    """Return the hosts and ports of a setting; no host for one that is not called by UDP."""
    found = []
    for text in filter(None, (part.strip() for part in setting.split(";"))):
        match = _ADDRESS.fullmatch(text)
        host = match and (match["host"] or match["v6"])
        found.append((host or "", int(match["port"] or _DEFAULT_PORT) if match else 0))
    return found


def _call(host: str, port: int) -> socket.socket | None:
    """Return a socket that has sent something there; None where that cannot be."""
    if not host:
        return None
    with suppress(OSError, OverflowError):
        (family, kind, protocol, _, address), *_ = socket.getaddrinfo(host, port, type=socket.SOCK_DGRAM)
        one = socket.socket(family, kind, protocol)
        with suppress(OSError):
            one.connect(address)
            one.send(_HEADER)
        return one
    return None


def _has_refused(one: socket.socket) -> bool:
    return one.getsockopt(socket.SOL_SOCKET, socket.SO_ERROR) != 0
