"""Runs the filter's node until it is told to end."""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Event, Thread

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

from bringup.filter.parameter_reader import ParameterError
from bringup.filter_node.node import FilterNode

ENDING = (signal.SIGINT, signal.SIGTERM)


def run() -> int:
    """Run until SIGINT or SIGTERM; gives the process's exit status, 1 if the parameters cannot be used.

    Both signals must be blocked by the caller: they are waited for in a thread of their own, so that nothing is
    ever interrupted half-way and the node leaves the graph at once.
    """
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    try:
        with _node() as node:
            return _spin(node)
    finally:
        rclpy.shutdown()


@contextmanager
def _node() -> Iterator[Node]:
    node = rclpy.create_node("ekf", automatically_declare_parameters_from_overrides=True)
    try:
        yield node
    finally:
        node.destroy_node()


def _spin(node: Node) -> int:
    try:
        running = FilterNode(node)
    except ParameterError as error:
        node.get_logger().fatal(str(error))
        return 1
    told_to_end = Event()
    # Its callback does nothing: it makes the executor come back.
    wake_up = node.create_guard_condition(lambda: None)
    Thread(target=_wait_for_the_end, args=(told_to_end, wake_up.trigger), daemon=True).start()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        while not told_to_end.is_set():
            executor.spin_once()
            running.update_if_due()
    finally:
        executor.remove_node(node)
        executor.shutdown()
    return 0


def _wait_for_the_end(told_to_end: Event, wake_up: Callable[[], None]) -> None:
    signal.sigwait(ENDING)
    told_to_end.set()
    wake_up()
