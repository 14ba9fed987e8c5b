"""Which participants this machine has in a domain, by the ports on which they hear of each other.

Source: DDSI-RTPS 2.5, 9.6.2.4: the participant with the number n of a domain d hears of others on the UDP port
7400 + 250 d + 10 + 2 n, and of messages on the next one. Fast DDS keeps to it unless its profiles say otherwise. Only
where both are bound it is a participant: in the domains from 102 on, sockets of any program may come to have one.
"""

from __future__ import annotations

import os
import socket
from contextlib import suppress
from pathlib import Path
from typing import Final

_BASE: Final = 7400
_PER_DOMAIN: Final = 250
_FIRST: Final = 10
_LAST: Final = 101  # beyond it are ports that the kernel hands out to anybody
# The columns of /proc/net/udp (proc(5)): local address, inode.
_LOCAL, _INODE = 1, 9
_DIGITS: Final = 4
_TABLE: Final = Path("/proc/self/net/udp")
ROOM: Final = 1 << 22


def participants_ports(domain: int, table: str) -> dict[int, str]:
    """Return the ports of participants of a domain in the text of /proc/net/udp, with the inode of each socket."""
    first = _BASE + _PER_DOMAIN * domain + _FIRST
    theirs = {f"{port:04X}": port for port in range(first, first + _PER_DOMAIN - _FIRST)}
    bound: dict[int, str] = {}
    for line in table.splitlines()[1:]:
        address = line.split(None, _LOCAL + 1)[_LOCAL]
        if (port := theirs.get(address[-_DIGITS:])) is not None:
            bound[port] = line.split()[_INODE]
    return {
        port: inode for port, inode in sorted(bound.items()) if (port - first) % 2 == 0 and port + 1 in bound
    }


def ports_here(domain: int) -> dict[int, str]:
    """Return those of this machine; none where it does not tell."""
    try:
        return participants_ports(domain, _TABLE.read_text("ascii"))
    except OSError:
        return {}


def tells_ports() -> bool:
    """Tell whether this machine tells which ports are bound."""
    return os.access(_TABLE, os.R_OK)


def domains_here(own: int) -> dict[int, int]:
    """Return how many participants this machine has in our own domain and each other; none where it does not tell."""
    try:
        table = _TABLE.read_text("ascii")
    except OSError:
        return {}
    counts = {domain: len(participants_ports(domain, table)) for domain in sorted({own, *range(_LAST + 1)})}
    return {domain: count for domain, count in counts.items() if count}


def widen() -> None:
    """Give the UDP sockets of this process room for what all others answer at once.

    Twenty nodes answer a new participant with a thousand datagrams, for which the kernel's usual 208 kB are too little:
    of what is lost, some comes again after seconds only. The kernel gives as much of it as it allows (rmem_max), and a
    middleware that was told another size in its profile keeps that where it is more.
    """
    for descriptor in list(Path("/proc/self/fd").iterdir()):
        with suppress(OSError):  # closed since
            if str(descriptor.readlink()).startswith("socket:"):
                with socket.socket(fileno=os.dup(int(descriptor.name))) as one:
                    if one.type == socket.SOCK_DGRAM and one.family in (socket.AF_INET, socket.AF_INET6):
                        _widen(one)


def _widen(one: socket.socket) -> None:
    if one.getsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF) < ROOM:
        one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, ROOM)


def own_port(ports: dict[int, str]) -> int | None:
    """Return the port that this process listens on."""
    ours = set()
    for descriptor in os.scandir("/proc/self/fd"):
        with suppress(OSError):  # closed since
            ours.add(os.readlink(descriptor.path))  # noqa: PTH115 - a text, as fast as it comes
    return next((port for port, inode in ports.items() if f"socket:[{inode}]" in ours), None)
