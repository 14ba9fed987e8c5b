"""Runs the controller's node until it is told to end."""

from __future__ import annotations

import signal
from threading import Event, Thread

import rclpy
from rclpy.exceptions import InvalidParameterTypeException, InvalidParameterValueException
from rclpy.executors import SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions

from bringup.control_node.node import VelocityController
from bringup.control_node.parameters import UnusableSettingsError
from bringup.filter.settings import NANOSECONDS
from bringup.filter_node.ticks import Ticks

ENDING = (signal.SIGINT, signal.SIGTERM)
REFUSALS = (InvalidParameterTypeException, InvalidParameterValueException, UnusableSettingsError)
FREQUENCY = 10.0


def run() -> int:
    """Run until SIGINT or SIGTERM; gives the process's exit status, 1 if the parameters cannot be used.

    Both signals must be blocked by the caller. They are waited for in a thread instead of being handled: rclpy's
    own handler shuts the context down at once, and then the last order to stand still could not be sent any more.
    """
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    try:
        node = rclpy.create_node("velocity_controller")
        try:
            _spin(node, VelocityController(node))
        except REFUSALS as error:
            node.get_logger().fatal(str(error))
            return 1
        finally:
            node.destroy_node()
    finally:
        rclpy.shutdown()
    return 0


def _spin(node: rclpy.node.Node, controller: VelocityController) -> None:
    told_to_end = Event()
    # Its callback does nothing: it makes the executor come back.
    wake_up = node.create_guard_condition(lambda: None)

    def wait_for_the_end() -> None:
        signal.sigwait(ENDING)
        told_to_end.set()
        wake_up.trigger()

    ending = Thread(target=wait_for_the_end, daemon=True)
    ending.start()
    ticks = Ticks(node, FREQUENCY)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        while not told_to_end.is_set():
            executor.spin_once(longest_wait(ticks.left()))
            if ticks.take() is not None:
                controller.tick()
        # A message may have ended the last wait before the trigger could: it must not meet a destroyed node.
        ending.join()
        controller.stand_still()
    finally:
        executor.remove_node(node)
        executor.shutdown()


def longest_wait(left: int | None) -> float | None:
    """Seconds to wait for something to happen when the next tick is `left` ns away; None: until it happens.

    On simulated time a clock message wakes the node. On the machine's clock nothing may, if the sensors are
    silent, and the time left may be any number if that clock is set back: never more than a period.
    """
    return None if left is None else min(left / NANOSECONDS, 1.0 / FREQUENCY)
