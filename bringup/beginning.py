"""Nodes begin with what ROS makes of their command line; one that it cannot read ends them, and a line says why."""

from __future__ import annotations

import difflib
import sys
from typing import TYPE_CHECKING

import rclpy
from rclpy.exceptions import (
    InvalidParameterTypeException,
    InvalidParameterValueException,
    ParameterUninitializedException,
)
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.signals import SignalHandlerOptions

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from rclpy.node import Node

# What rclpy raises for a value of a declared parameter: another type, out of its range, no type (an empty list).
REFUSED_VALUES = (
    InvalidParameterTypeException,
    InvalidParameterValueException,
    ParameterUninitializedException,
)


def begun(name: str, run: Callable[[], int], args: list[str] | None = None) -> int:
    """Run with ROS at hand, without its signal handlers; gives what `run` gives, 1 if ROS refuses the command line."""
    try:
        rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    except rclpy_implementation.UnknownROSArgsError as error:
        return _refuse(name, f"unknown arguments after --ros-args: {error}")
    except rclpy_implementation.RCLError as error:
        # Of a parameter file that cannot be read the message tells file and line.
        return _refuse(name, str(error))
    try:
        return run()
    finally:
        rclpy.shutdown()


def _refuse(name: str, reason: str) -> int:
    """Say why a node cannot begin; there is no logger yet."""
    sys.stderr.write(f"{name}: {reason}\n")
    return 1


def tell_unknown(node: Node, known: Collection[str]) -> None:
    """Warn of values given at the start that no parameter takes: rclpy drops them without a word."""
    for name in sorted(node._parameter_overrides):  # noqa: SLF001 - rclpy tells it nowhere else
        if node.has_parameter(name) or name.startswith("qos_overrides."):
            continue
        near = difflib.get_close_matches(name, known, n=1)
        hint = f"; did you mean {near[0]}?" if near else ""
        node.get_logger().warning(f"parameter {name} is unknown and has no effect{hint}")
