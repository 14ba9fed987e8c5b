"""A hidden node of ours in the graph, for as long as a command lasts."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

import rclpy
from rclpy.exceptions import NameValidationException
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.signals import SignalHandlerOptions

from orchestra.errors import RunError
from orchestra.ros.tools.graph.bare import one_line
from orchestra.ros.tools.graph.counting import Counted
from orchestra.ros.tools.graph.ending import Ending
from orchestra.ros.tools.graph.seeing import ARGUMENTS, Graph, entering, own_name, told

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Iterator

    from rclpy.node import Node

__all__ = ["Graph", "joined"]


@contextmanager
def joined(options: Namespace) -> Iterator[Graph]:
    """Join the graph with a hidden node."""
    with entering():
        rclpy.init(args=list(ARGUMENTS), signal_handler_options=SignalHandlerOptions.NO)
    try:
        with Ending() as ending:
            with entering():
                node = _node(options)
            executor = SingleThreadedExecutor(context=node.context)
            executor.add_node(node)
            graph = Graph(node, Counted(node), float(options.spin_time), ending, executor.spin_once)
            try:
                yield graph
            except NameValidationException as error:
                raise RunError(one_line(error)) from None
            except ValueError as error:
                raise told(error) from None
            finally:
                graph.close()
    finally:
        rclpy.try_shutdown()


def _node(options: Namespace) -> Node:
    return rclpy.create_node(
        own_name(options),
        start_parameter_services=False,
        enable_rosout=False,
        parameter_overrides=[Parameter("use_sim_time", value=True)] if options.use_sim_time else [],
    )
