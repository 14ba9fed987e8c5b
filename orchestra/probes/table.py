"""The readiness conditions by their key in a launch file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.probes.log import LogProbe
from orchestra.probes.message import MessageProbe

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.plan.conditions import Ready
    from orchestra.probes.protocol import Probe

PROBES: dict[str, Callable[[str], Probe]] = {
    "log": LogProbe,
    "message": MessageProbe,
}


def probe_for(ready: Ready) -> Probe:
    """Return the condition that is written. Raises `ValueError` where none is."""
    for key, make in PROBES.items():
        value = getattr(ready, key)
        if value is not None:
            return make(value)
    raise ValueError("ready without a condition")
