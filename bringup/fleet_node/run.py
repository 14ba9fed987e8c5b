"""Runs the monitor's node until it is told to end."""

from __future__ import annotations

from rclpy.logging import get_logger

from bringup.beginning import REFUSED_VALUES, begun
from bringup.ending import leave, spin_until_told
from bringup.fleet_node.node import FleetMonitor


def run() -> int:
    """Run until SIGINT or SIGTERM; gives the process's exit status, 1 if the parameters cannot be used.

    Both signals must be blocked by the caller: they are waited for in a thread of their own, so that nothing is
    ever interrupted half-way and the node leaves the graph at once.
    """
    return begun("fleet_monitor", _run)


def _run() -> int:
    try:
        node = FleetMonitor()
    except REFUSED_VALUES as error:
        get_logger("fleet_monitor").fatal(str(error))
        return 1
    spin_until_told(node)
    leave(node)
    return 0
