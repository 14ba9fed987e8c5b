"""Ready when a TCP port accepts a connection."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.probes.address import Addresses, target
from orchestra.probes.repeated import Repeated
from orchestra.probes.visit import Visit, nothing

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.probes.protocol import Cancel, Site


def tcp_probe(text: str, interval: float) -> Repeated:
    """Return the condition that `HOST:PORT` accepts a connection, which is closed at once."""
    goal = target(text)
    addresses = Addresses(goal) if goal else None

    def attempt(site: Site, told: Callable[[str | None], None]) -> Cancel | None:
        if addresses is None:
            told("not HOST:PORT")
            return None
        return Visit(site, addresses, nothing, told)

    return Repeated(f"tcp {text}", attempt, interval)
