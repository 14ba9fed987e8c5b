"""Runs the monitor's node until it is told to end."""

from __future__ import annotations

import rclpy
from rclpy.exceptions import InvalidParameterTypeException, InvalidParameterValueException
from rclpy.signals import SignalHandlerOptions

from bringup.ending import spin_until_told
from bringup.fleet_node.node import FleetMonitor

REFUSALS = (InvalidParameterTypeException, InvalidParameterValueException)


def run() -> int:
    """Run until SIGINT or SIGTERM; gives the process's exit status, 1 if the parameters cannot be used.

    Both signals must be blocked by the caller: they are waited for in a thread of their own, so that nothing is
    ever interrupted half-way and the node leaves the graph at once.
    """
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    try:
        try:
            node = FleetMonitor()
        except REFUSALS as error:
            rclpy.logging.get_logger("fleet_monitor").fatal(str(error))
            return 1
        spin_until_told(node)
        node.destroy_node()
    finally:
        rclpy.shutdown()
    return 0
