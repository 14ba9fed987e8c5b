"""The readiness conditions by their key in a launch file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.probes import graph
from orchestra.probes.command import command_probe
from orchestra.probes.file import file_probe
from orchestra.probes.http import http_probe
from orchestra.probes.log import LogProbe
from orchestra.probes.notify import NotifyProbe
from orchestra.probes.tcp import tcp_probe

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.plan.conditions import Ready
    from orchestra.probes.protocol import Probe

# From what is written, and the seconds between two attempts, to the condition.
PROBES: dict[str, Callable[[Any, float], Probe]] = {
    "log": lambda pattern, _interval: LogProbe(pattern),
    "tcp": tcp_probe,
    "http": http_probe,
    "file": file_probe,
    "command": command_probe,
    "notify": lambda _true, _interval: NotifyProbe(),
    "node": lambda name, _interval: graph.node(name),
    "topic": lambda name, _interval: graph.topic(name),
    "message": lambda name, _interval: graph.message(name),
    "service": lambda name, _interval: graph.service(name),
    "action": lambda name, _interval: graph.action(name),
    "parameter": lambda fact, _interval: graph.parameter(fact),
    "lifecycle": lambda fact, _interval: graph.lifecycle(fact),
    "tf": lambda fact, _interval: graph.transform(fact),
}


def probes_for(ready: Ready) -> dict[str, Probe]:
    """Return the conditions that are written, by key: all of them have to come about.

    Raises `ValueError` where there is none.
    """
    written = {key: value for key in PROBES if (value := getattr(ready, key)) not in (None, False)}
    if not written:
        raise ValueError("ready without a condition")
    return {key: PROBES[key](value, ready.interval) for key, value in written.items()}
