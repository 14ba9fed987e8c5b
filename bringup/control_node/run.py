"""Runs a node that drives, in ticks of ROS time, until it is told to end."""

from __future__ import annotations

import signal
from threading import Event, Thread
from typing import TYPE_CHECKING, Protocol

import rclpy
from rclpy.exceptions import InvalidParameterTypeException, InvalidParameterValueException
from rclpy.executors import SingleThreadedExecutor
from rclpy.logging import get_logger
from rclpy.signals import SignalHandlerOptions

from bringup.control_node.parameters import UnusableSettingsError
from bringup.filter.settings import NANOSECONDS
from bringup.filter_node.ticks import Ticks

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

ENDING = (signal.SIGINT, signal.SIGTERM)
REFUSALS = (InvalidParameterTypeException, InvalidParameterValueException, UnusableSettingsError)
FREQUENCY = 10.0
# Turns of the executor at the end, in which clients of goals are told.
LAST_TURNS = 5


class Driving(Protocol):
    """A node of rclpy that does something at each tick."""

    def tick(self) -> None:
        """Do what is due."""

    def stand_still(self, reason: str) -> None:
        """Order the robot to stand: nothing is done after this."""


def run(make: Callable[[], Any], name: str, frequency: float = FREQUENCY) -> int:
    """Run what `make` makes until SIGINT or SIGTERM; gives the exit status, 1 if the parameters cannot be used.

    Both signals must be blocked by the caller. They are waited for in a thread instead of being handled: rclpy's
    own handler shuts the context down at once, and then the last order to stand still could not be sent any more.
    """
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    try:
        try:
            node = make()
        except REFUSALS as error:
            get_logger(name).fatal(str(error))
            return 1
        try:
            _spin(node, node, frequency)
        finally:
            node.destroy_node()
    finally:
        rclpy.shutdown()
    return 0


def _spin(node: rclpy.node.Node, driving: Driving, frequency: float) -> None:
    told_to_end = Event()
    # Its callback does nothing: it makes the executor come back.
    wake_up = node.create_guard_condition(lambda: None)

    def wait_for_the_end() -> None:
        signal.sigwait(ENDING)
        told_to_end.set()
        wake_up.trigger()

    ending = Thread(target=wait_for_the_end, daemon=True)
    ending.start()
    ticks = Ticks(node, frequency)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        while not told_to_end.is_set():
            executor.spin_once(longest_wait(ticks.left(), frequency))
            if ticks.take() is not None:
                driving.tick()
        # A message may have ended the last wait before the trigger could: it must not meet a destroyed node.
        ending.join()
        driving.stand_still("the node ends")
        for _ in range(LAST_TURNS):
            executor.spin_once(timeout_sec=0.0)
    finally:
        executor.remove_node(node)
        executor.shutdown()


def longest_wait(left: int | None, frequency: float = FREQUENCY) -> float | None:
    """Seconds to wait for something to happen when the next tick is `left` ns away; None: until it happens.

    On simulated time a clock message wakes the node. On the machine's clock nothing may, if the sensors are
    silent, and the time left may be any number if that clock is set back: never more than a period.
    """
    return None if left is None else min(left / NANOSECONDS, 1.0 / frequency)
