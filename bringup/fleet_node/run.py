"""Runs the monitor's node until it is told to end."""

from __future__ import annotations

import signal
from threading import Event, Thread

import rclpy
from rclpy.exceptions import InvalidParameterTypeException, InvalidParameterValueException
from rclpy.executors import SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions

from bringup.fleet_node.node import FleetMonitor

ENDING = (signal.SIGINT, signal.SIGTERM)
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
        _spin(node)
        node.destroy_node()
    finally:
        rclpy.shutdown()
    return 0


def _spin(node: FleetMonitor) -> None:
    told_to_end = Event()
    # Its callback does nothing: it makes the executor come back.
    wake_up = node.create_guard_condition(lambda: None)

    def wait_for_the_end() -> None:
        signal.sigwait(ENDING)
        told_to_end.set()
        wake_up.trigger()

    ending = Thread(target=wait_for_the_end, daemon=True)
    ending.start()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        while not told_to_end.is_set():
            executor.spin_once()
        # The trigger must not meet a destroyed node.
        ending.join()
    finally:
        executor.remove_node(node)
        executor.shutdown()
