"""A ROS domain that nobody else on this machine talks in.

Two things are looked at: a lock that other test sessions hold, and the ports that participants of a domain have open
(DDSI-RTPS 2.5, 9.6.2.3: domain `d` has the 250 UDP ports from 7400 + 250 d). The lock is a name in the abstract socket
namespace (unix(7)): it goes with its holder, however that ends, and it counts for exactly the processes that share a
network. Random numbers without a lock collide.
"""

from __future__ import annotations

import os
import socket
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

FIRST, LAST = 1, 100  # 0 is everybody's default; beyond 101 the ports are those that the kernel hands out
_PORT_BASE, _PORTS_PER_DOMAIN = 7400, 250


@contextmanager
def free_domain(environment: Mapping[str, str]) -> Iterator[int]:
    """Hold a domain id. One that the environment gives as `ROS_DOMAIN_ID` is used as it is, and not locked.

    Raises `RuntimeError` where no domain is free.
    """
    given = environment.get("ROS_DOMAIN_ID")
    if given:
        yield int(given)
        return
    busy = _busy_domains()
    count = LAST - FIRST + 1
    for step in range(count):
        domain = FIRST + (os.getpid() + step) % count
        lock = None if domain in busy else _locked(domain)
        if lock:
            with lock:
                yield domain
            return
    raise RuntimeError(f"all ROS domains from {FIRST} to {LAST} are in use on this machine")


def _locked(domain: int) -> socket.socket | None:
    """Return the lock of a domain, None where somebody else has it."""
    lock = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    try:
        lock.bind(f"\0orchestra-ros-domain-{domain}")
    except OSError:
        lock.close()
        return None
    return lock


def _busy_domains() -> set[int]:
    """Return the domains of all open UDP ports (proc(5), /proc/net/udp)."""
    ports: set[int] = set()
    for table in ("/proc/net/udp", "/proc/net/udp6"):
        with suppress(OSError):  # a kernel without IPv6 has no table for it
            rows = Path(table).read_text("ascii").splitlines()[1:]
            ports.update(int(row.split()[1].rpartition(":")[2], 16) for row in rows)
    return {(port - _PORT_BASE) // _PORTS_PER_DOMAIN for port in ports if port >= _PORT_BASE}
