"""Runs a node that drives, in ticks of ROS time, until it is told to end."""

from __future__ import annotations

from threading import Event, Thread
from typing import TYPE_CHECKING, Protocol

from rclpy.logging import get_logger

from bringup.beginning import REFUSED_VALUES, begun
from bringup.control_node.parameters import UnusableSettingsError
from bringup.control_node.taking import TAKEN_WHEN_NEEDED
from bringup.ending import leave, wait_for_the_end
from bringup.filter.settings import NANOSECONDS
from bringup.filter_node.ticks import Ticks
from bringup.filter_node.waiting import Waiting

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from rclpy.node import Node

REFUSALS = (*REFUSED_VALUES, UnusableSettingsError)
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
    return begun(name, lambda: _run(make, name, frequency))


def _run(make: Callable[[], Any], name: str, frequency: float) -> int:
    try:
        node = make()
    except REFUSALS as error:
        get_logger(name).fatal(str(error))
        return 1
    try:
        _spin(node, node, frequency)
    finally:
        leave(node)
    return 0


def _spin(node: Node, driving: Driving, frequency: float) -> None:
    told_to_end = Event()
    ticks = Ticks(node, frequency)
    with Waiting(node, TAKEN_WHEN_NEEDED) as waiting:
        ending = Thread(target=wait_for_the_end, args=(told_to_end, waiting.wake_up), daemon=True)
        ending.start()
        while not told_to_end.is_set():
            if waiting.wait(longest_wait(ticks.left(), frequency)):
                waiting.serve()
            if ticks.take() is not None:
                driving.tick()
                # What goals and claims have left with the executor, which does not wake this loop.
                waiting.serve()
        # A message may have ended the last wait before the trigger could: it must not meet a destroyed node.
        ending.join()
        driving.stand_still("the node ends")
        for _ in range(LAST_TURNS):
            waiting.serve()


def longest_wait(left: int | None, frequency: float = FREQUENCY) -> int:
    """Nanoseconds to wait for something to happen when the next tick is `left` ns away; -1: until it happens.

    On simulated time a clock message wakes the node. On the machine's clock nothing may, if the sensors are
    silent, and the time left may be any number if that clock is set back: never more than a period.
    """
    return -1 if left is None else min(left, round(NANOSECONDS / frequency))
