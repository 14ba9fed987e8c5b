"""Runs the filter's node until it is told to end."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Event, Thread
from time import monotonic, sleep

import rclpy
from rclpy.logging import get_logger
from rclpy.node import Node

from bringup.beginning import begun
from bringup.ending import leave, wait_for_the_end
from bringup.filter.parameter_reader import ParameterError
from bringup.filter_node.node import FilterNode
from bringup.filter_node.waiting import Waiting

# Seconds after which the executor gets its turn without a service being called: rclpy's own warnings come this way.
_LONGEST_UNSERVED = 1.0


def run() -> int:
    """Run until SIGINT or SIGTERM; gives the process's exit status, 1 if the parameters cannot be used.

    Both signals must be blocked by the caller: they are waited for in a thread of their own, so that nothing is
    ever interrupted half-way and the node leaves the graph at once.
    """
    return begun("ekf", _run)


def _run() -> int:
    try:
        with _node() as node:
            return _spin(node)
    except ParameterError as error:
        get_logger("ekf").fatal(str(error))
        return 1


@contextmanager
def _node() -> Iterator[Node]:
    try:
        node = rclpy.create_node("ekf", automatically_declare_parameters_from_overrides=True)
    except ValueError as error:
        raise ParameterError(
            f"a parameter has no type, such as an empty list; leave it out ({error})"
        ) from error
    try:
        yield node
    finally:
        leave(node)


def _spin(node: Node) -> int:
    try:
        running = FilterNode(node)
    except ParameterError as error:
        node.get_logger().fatal(str(error))
        return 1
    told_to_end = Event()
    with Waiting(node, running.visited_group) as waiting, running.traced():
        ending = Thread(target=wait_for_the_end, args=(told_to_end, waiting.wake_up), daemon=True)
        ending.start()
        served = monotonic()
        # What is there by now stays: the collector need not go through it again and again.
        gc.freeze()
        while not told_to_end.is_set():
            called = waiting.wait(running.time_left())
            if called or monotonic() - served > _LONGEST_UNSERVED:
                waiting.serve()
                served = monotonic()
            running.work()
            rest = running.rest()
            if rest > 0.0:
                sleep(rest)
                waiting.look_at_the_clock()
                running.work()
        # A message may have ended the last wait before the trigger could: it must not meet a destroyed node.
        ending.join()
    return 0
