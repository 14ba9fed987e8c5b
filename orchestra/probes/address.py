"""Addresses to connect to: those that are written as numbers or are this machine, and names that must be looked up.

Looking up a name may take as long as its servers like (getaddrinfo(3)), so a process of its own does it.
"""

from __future__ import annotations

import json
import socket
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.probes.protocol import Cancel, Result, Site

# In seconds: how long a lookup may take, and how long its result is used.
_WITHIN = 5.0
_KEEP = 5.0
_KEEP_FAULT = 1.0
_COMMAND = (sys.executable, "-I", "-S", str(Path(__file__).with_name("lookup.py")))

# What socket(2) and connect(2) want: the family, and the address as Python gives it.
Address: TypeAlias = tuple[int, tuple[Any, ...]]


class Target(NamedTuple):
    """A host, by its name or as a number, and a port."""

    host: str
    port: int


def target(text: str) -> Target | None:
    """Read `HOST:PORT`, with an IPv6 address in brackets; no host is this machine. None where it is something else."""
    host, colon, port = text.rpartition(":")
    host = host.removeprefix("[").removesuffix("]")
    if not colon or not port.isascii() or not port.isdigit() or not 0 < int(port) < 1 << 16:
        return None
    return Target(host or "localhost", int(port))


def known(goal: Target) -> list[Address] | None:
    """Return the addresses that need no lookup; None for a name that does."""
    if goal.host == "localhost":
        return [(socket.AF_INET, ("127.0.0.1", goal.port)), (socket.AF_INET6, ("::1", goal.port))]
    try:
        found = socket.getaddrinfo(goal.host, goal.port, type=socket.SOCK_STREAM, flags=socket.AI_NUMERICHOST)
    except (OSError, ValueError):  # a name, or what cannot even be one
        return None
    return [(family, address) for family, _, _, _, address in found]


class Addresses:
    """The addresses of one target; what a lookup has found serves some attempts."""

    def __init__(self, goal: Target) -> None:
        self._goal = goal
        self._found = known(goal)
        self._fault: str | None = None
        self._until = float("inf") if self._found else 0.0

    def find(self, site: Site, told: Callable[[list[Address], str | None], None]) -> Cancel | None:
        """Tell the addresses, or what is wrong; at once where they are known."""
        if time.monotonic() < self._until:
            told(self._found or [], self._fault)
            return None

        def heard(result: Result) -> None:
            self._keep(result)
            told(self._found or [], self._fault)

        return site.run((*_COMMAND, self._goal.host, str(self._goal.port)), _WITHIN, heard)

    def _keep(self, result: Result) -> None:
        self._fault = result.fault
        self._found = None
        if result.fault is None:
            self._found = [(family, tuple(address)) for family, address in json.loads(result.output)]
        self._until = time.monotonic() + (_KEEP if self._found else _KEEP_FAULT)
