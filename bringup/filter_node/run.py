"""Runs the filter's node until it is told to end."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Thread

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future

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
        FilterNode(node)
    except ParameterError as error:
        node.get_logger().fatal(str(error))
        return 1
    told_to_end = Future()
    Thread(target=lambda: told_to_end.set_result(signal.sigwait(ENDING)), daemon=True).start()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        executor.spin_until_future_complete(told_to_end)
    finally:
        executor.remove_node(node)
        executor.shutdown()
    return 0
